function example_contact_path(file, picture)
%EXAMPLE_CONTACT_PATH  Where the contacts of a sweep are on the moving body, seen along their mean normal.
%
%   example_contact_path('run.h5') shows it, example_contact_path('run.h5', 'path.png') writes a picture.
%   Coordinates are those of the body's own mesh.

if nargin < 2
  picture = '';
end
run = condyle_read_run(file);
names = fieldnames(run.sweep.contacts);
page = new_page(picture, [16 10]);
hold on

% Along which axis of the mesh one looks: that of the mean normal in the moving body.
normal = zeros(1, 3);
for k = 1:numel(names)
  normal = normal + mean_normal(run.sweep, run.sweep.contacts.(names{k}));
end
[~, along] = max(abs(normal));
seen = setdiff(1:3, along);
axis_names = 'xyz';

entries = {};
lines = [];
for k = 1:numel(names)
  contact = run.sweep.contacts.(names{k});
  closed = contact.state == 1;
  value = run.sweep.value(closed);
  point = contact.point_moving(closed, :);
  draw_patch(run, point, seen);
  lines(end + 1) = plot(point(:, seen(1)), point(:, seen(2)), '-o', 'Color', line_colour(k), ...
    'MarkerFaceColor', line_colour(k), 'MarkerSize', 4, 'LineWidth', 1.5); %#ok<AGROW>
  entries{end + 1} = strrep(names{k}, '_', ' '); %#ok<AGROW>
  ends = [1 numel(value)];
  for i = ends(1:min(2, numel(value)))
    text(point(i, seen(1)), point(i, seen(2)) + 4, sprintf('%g', value(i)), 'HorizontalAlignment', 'center');
  end
end
hold off
axis equal
xlabel([axis_names(seen(1)) ' (mm)']);
ylabel([axis_names(seen(2)) ' (mm)']);
title('contact on the moving body, at the first and last value');
legend(lines, entries, 'Location', 'northeastoutside');
save_page(page, picture);
end

function normal = mean_normal(sweep, contact)
normal = zeros(1, 3);
for i = find(contact.state' == 1)
  R = squeeze(sweep.pose.rotation(i, :, :));
  normal = normal + contact.normal_ground(i, :) * R;  % R' n, as a row
end
end

function draw_patch(run, point, seen)
% The patch under the path: control points of the surface that it comes closest to.
if isempty(point)
  return
end
surfaces = fieldnames(run.patches);
best = inf;
for k = 1:numel(surfaces)
  net = reshape(run.patches.(surfaces{k}).control_points, [], 3);
  off = min(sum((net - repmat(mean(point, 1), size(net, 1), 1)).^2, 2));
  if off < best && lies_on_moving_body(run, surfaces{k})
    best = off;
    under = net;
  end
end
if isfinite(best)
  plot(under(:, seen(1)), under(:, seen(2)), '.', 'Color', [0.75 0.75 0.75], 'MarkerSize', 4);
end
end

function yes = lies_on_moving_body(run, surface)
% A scene says `fixed = true` of the other one.
blocks = strsplit(run.scene, '[[body]]');
yes = true;
for k = 2:numel(blocks)
  block = strtok(blocks{k}, '[');
  if ~isempty(strfind(block, ['"' run.patches.(surface).body '"'])) && ... %#ok<STREMP>
      ~isempty(regexp(block, 'fixed\s*=\s*true', 'once'))
    yes = false;
  end
end
end
