function example_sweep(file, picture)
%EXAMPLE_SWEEP  Forces of contacts and ligaments over a sweep.
%
%   example_sweep('run.h5') shows them, example_sweep('run.h5', 'run.png') writes a picture without a display.

if nargin < 2
  picture = '';
end
[run, info] = condyle_read_run(file, '/sweep');
x_words = sprintf('swept value (%s)', info(strcmp({info.field}, 'value')).units);
solved = run.status == 0;
value = run.value(solved);

page = new_page(picture, [16 16]);
subplot(2, 1, 1);
draw_forces(value, group_of(run, 'contacts'), solved, 2, x_words);
title('contacts');
subplot(2, 1, 2);
draw_forces(value, group_of(run, 'ligaments'), solved, 8, x_words);
title('ligaments, the eight that carry most');
save_page(page, picture);
end

function group = group_of(run, name)
% Without fields where the scene has none of them.
group = struct();
if isfield(run, name) && isstruct(run.(name))
  group = run.(name);
end
end

function draw_forces(value, group, solved, most, x_words)
% Those with the greatest peaks, each with a colour and a kind of line of its own.
names = fieldnames(group);
peaks = cellfun(@(name) max([0; group.(name).force(solved)]), names);
[~, order] = sort(peaks, 'descend');
names = names(order(1:min(most, numel(order))));
if isempty(names)
  return
end
hold on
for k = 1:numel(names)
  plot(value, group.(names{k}).force(solved), line_style(k), 'Color', line_colour(k), 'LineWidth', 1.5);
end
hold off
xlabel(x_words);
ylabel('force (N)');
legend(strrep(names, '_', ' '), 'Location', 'northeastoutside');
grid on
end
