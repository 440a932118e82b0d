function example_sweep(file, picture)
%EXAMPLE_SWEEP  Forces of contacts and ligaments over a sweep.
%
%   example_sweep('run.h5') shows them, example_sweep('run.h5', 'run.png') writes a picture without a display.

if nargin < 2
  picture = '';
end
run = condyle_read_run(file, '/sweep');
solved = run.status == 0;
value = run.value(solved);

page = new_page(picture, [16 16]);
subplot(2, 1, 1);
draw_forces(value, run.contacts, solved, 2);
title('contacts');
subplot(2, 1, 2);
draw_forces(value, run.ligaments, solved, 8);
title('ligaments, the eight that carry most');
save_page(page, picture);
end

function draw_forces(value, group, solved, most)
% Those with the greatest peaks, each with a colour and a kind of line of its own.
names = fieldnames(group);
peaks = cellfun(@(name) max([0; group.(name).force(solved)]), names);
[~, order] = sort(peaks, 'descend');
names = names(order(1:min(most, numel(order))));
hold on
for k = 1:numel(names)
  plot(value, group.(names{k}).force(solved), line_style(k), 'Color', line_colour(k), 'LineWidth', 1.5);
end
hold off
xlabel('flexion (deg)');
ylabel('force (N)');
legend(strrep(names, '_', ' '), 'Location', 'northeastoutside');
grid on
end
