function example_laxity(file, picture)
%EXAMPLE_LAXITY  Anterior drawer against its load, of the whole knee and after the cut.
%
%   example_laxity('laxity.h5') shows it, example_laxity('laxity.h5', 'laxity.png') writes a picture.
%   The file is one of `condyle laxity` with an anterior load.

if nargin < 2
  picture = '';
end
[laxity, info] = condyle_read_run(file, '/laxity');
units = info(strcmp({info.field}, 'load')).units;
knees = {'intact', 'cut'};
knees = knees(isfield(laxity, knees));
page = new_page(picture, [16 16]);
for k = 1:numel(knees)
  subplot(numel(knees), 1, k);
  test = laxity.(knees{k}).ours;
  drawer = test.joint.anterior_drawer;
  drawer(test.status ~= 0) = NaN;
  hold on
  for f = 1:numel(laxity.flexion)
    plot(laxity.load, drawer(f, :)', line_style(f), 'Color', line_colour(f), 'LineWidth', 1.5);
  end
  hold off
  title(knees{k});
  xlabel(['anterior load (' units ')']);
  ylabel('anterior drawer (mm)');
  legend(arrayfun(@(f) sprintf('%g deg', f), laxity.flexion, 'UniformOutput', false), 'Location', 'northeastoutside');
  grid on
end
save_page(page, picture);
end
