function save_page(page, picture)
%SAVE_PAGE  Writes a figure as PNG, 150 dots an inch, and closes it; nothing where no picture is named.

if isempty(picture)
  return
end
% Octave with gnuplot alone would go through Ghostscript.
if exist('OCTAVE_VERSION', 'builtin') > 0 && strcmp(get(page, '__graphics_toolkit__'), 'gnuplot')
  place = get(page, 'Position');
  set(findall(page, '-property', 'fontsize'), 'fontsize', 7);      % gnuplot takes them for larger than they are,
  set(findall(page, 'type', 'line'), 'linewidth', 3);              % and lines for thinner
  print(page, '-dpngcairo', sprintf('-S%d,%d', place(3:4)), picture);
else
  print(page, '-dpng', '-r150', picture);
end
close(page);
end
