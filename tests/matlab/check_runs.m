function check_runs(tools, stand_in)
%CHECK_RUNS  What octave_test.sh asks: tells all that is read of the runs in this folder, and draws the examples.

addpath(tools);
read = {'layered', '/'; 'wrapped', '/sweep'; 'compare', '/'; 'laxity', '/laxity'; 'simulate', '/simulate'; ...
        'calibrate', '/calibrate'; 'study', '/bands'; 'odd', '/'};
for k = 1:size(read, 1)
  file = [read{k, 1} '.h5'];
  [run, info] = condyle_read_run(file, read{k, 2});
  tell(file, read{k, 2}, run, info);
  runs.(read{k, 1}) = run;
end
check_texts(runs.layered, runs.odd);
check_refusals();

example_sweep('layered.h5', 'sweep.png');
example_contact_path('layered.h5', 'path.png');
example_laxity('laxity.h5', 'laxity.png');
example_pressure('layered.h5', 60, 'pressure.png');

% As in MATLAB: h5info and h5read are there.
addpath(stand_in);
for k = [4 8]
  assert(isequaln(condyle_read_run([read{k, 1} '.h5'], read{k, 2}), runs.(read{k, 1})), read{k, 1});
end
[~, other] = condyle_read_run('odd.h5');
rmpath(stand_in);
[~, info] = condyle_read_run('odd.h5');
[~, a] = sort({info.path});
[~, b] = sort({other.path});
assert(isequaln(info(a), other(b)));
end

function tell(file, group, run, info)
% A line for each dataset: path, units, shape, kind, values in the order of the file; texts as bytes in hexadecimal.
out = fopen(strrep(file, '.h5', '.told'), 'w');
fprintf(out, '%s\t%s\n', file, group);
for k = 1:numel(info)
  parts = strsplit(info(k).field, '.');
  value = getfield(run, parts{:});
  if ischar(value)
    value = {value};
  end
  kind = 'numbers';
  if iscell(value)
    kind = 'texts';
    values = strjoin(cellfun(@(text) [sprintf('%02x', double(text)) '.'], value(:)', 'UniformOutput', false), ' ');
  else
    assert(isa(value, 'double'), info(k).path);
    turned = permute(value, ndims(value):-1:1);
    values = sprintf('%.17g ', turned(:));
  end
  fprintf(out, '%s\t%s\t%s\t%s\t%s\n', info(k).path, info(k).units, sprintf('%d ', size(value)), kind, values);
end
fclose(out);
end

function check_texts(run, odd)
assert(strcmp(run.format, 'condyle 1'));
assert(ischar(run.scene) && any(run.scene == "\n") && any(run.scene == '"'));
assert(strcmp(run.patches.medial_plateau.body, 'tibia'));
assert(isequal(size(run.sweep.reason), [numel(run.sweep.value) 1]) && iscell(run.sweep.reason));
assert(isequal(size(run.sweep.pose.rotation), [numel(run.sweep.value) 3 3]));
R = squeeze(run.sweep.pose.rotation(2, :, :));
assert(norm(R * R' - eye(3)) < 1e-12 && abs(det(R) - 1) < 1e-12);
assert(isequal(sort(fieldnames(odd)), sort({'a_b'; 'a_b_1'; 'x1st'; 'numbers'; 'texts'; 'long'; 'quoted_name_'})));
end

function check_refusals()
refusals = {'none.h5', '/'; 'layered.h5', '/none'; 'log', '/'};
for k = 1:size(refusals, 1)
  said = '';
  try
    condyle_read_run(refusals{k, :});
  catch problem
    said = problem.message;
  end
  assert(~isempty(strfind(said, refusals{k, 1})) && ~any(said == "\n"), refusals{k, 1});
end
end

function yes = isequaln(a, b)
% Octave's isequaln comes with version 8.
if isstruct(a) && isstruct(b) && isequal(size(a), size(b)) && isequal(sort(fieldnames(a)), sort(fieldnames(b)))
  yes = true;
  for name = fieldnames(a)'
    for k = 1:numel(a)
      yes = yes && isequaln(a(k).(name{1}), b(k).(name{1}));
    end
  end
elseif isnumeric(a) && isnumeric(b)
  yes = isequal(size(a), size(b)) && all(a(:) == b(:) | (isnan(a(:)) & isnan(b(:))));
else
  yes = strcmp(class(a), class(b)) && isequal(a, b);
end
end
