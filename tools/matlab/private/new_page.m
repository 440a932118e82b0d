function page = new_page(picture, size_cm)
%NEW_PAGE  A figure of the size [width height] in cm, at 150 dots an inch; where a picture is to be written it is not shown.

visible = 'on';
if ~isempty(picture)
  visible = 'off';
end
pixels = round(size_cm / 2.54 * 150);
page = figure('Color', 'w', 'Units', 'pixels', 'Position', [50 50 pixels], 'PaperUnits', 'centimeters', ...
  'PaperSize', size_cm, 'PaperPosition', [0 0 size_cm], 'Visible', visible);
end
