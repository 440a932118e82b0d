function example_pressure(file, at, picture)
%EXAMPLE_PRESSURE  Pressure on elastic layers at one pose, on one surface of each contact.
%
%   example_pressure('layered.h5', 60) shows the pose nearest to 60 degrees, example_pressure('layered.h5', 60, 'map.png')
%   writes a picture. Every contact of the run has to have law = "layer". Of its two surfaces the second one is drawn.

if nargin < 3
  picture = '';
end
[sweep, info] = condyle_read_run(file, '/sweep');
units = info(strcmp({info.field}, 'value')).units;
[~, pose] = min(abs(sweep.value - at));
page = new_page(picture, [16 16]);
names = fieldnames(sweep.contacts);
for k = 1:numel(names)
  subplot(numel(names), 1, k);
  contact = sweep.contacts.(names{k});
  surfaces = fieldnames(contact.pressure);
  field = contact.pressure.(surfaces{end});
  rows = field.first(pose) + 1:field.first(pose + 1);
  scatter(field.place(rows, 1), field.place(rows, 2), 60, field.pressure(rows), 's', 'filled');
  axis equal
  xlabel('u (mm)');
  ylabel('v (mm)');
  title(sprintf('%s at %g %s, %.0f N', strrep(surfaces{end}, '_', ' '), sweep.value(pose), units, ...
    contact.force(pose)));
  colormap(blues());
  ylabel(colorbar(), 'N/mm^2');
end
save_page(page, picture);
end

function colours = blues()
% From light to dark: read without colours, too.
t = linspace(0, 1, 64)';
colours = (1 - t) * [0.87 0.92 0.97] + t * [0.03 0.19 0.42];
end
