function [run, info] = struct_of_items(items, top)
%STRUCT_OF_ITEMS  Groups within groups as structs within structs, and what is told of each dataset.
%
%   top: path of the group that becomes run.

paths = sort({items.path});
fields = containers.Map('KeyType', 'char', 'ValueType', 'any');  % path: names of the fields that lead there
taken = containers.Map('KeyType', 'char', 'ValueType', 'any');   % path of a group: names given in it
fields(top) = {};
for k = 1:numel(paths)
  if strcmp(paths{k}, top)
    continue
  end
  [above, name] = above_and_name(paths{k});
  if ~isKey(taken, above)
    taken(above) = {};
  end
  field = matlab.lang.makeUniqueStrings(field_of(name), taken(above));
  taken(above) = [taken(above) {field}];
  fields(paths{k}) = [fields(above) {field}];
end

run = struct();
info = struct('path', {}, 'field', {}, 'units', {}, 'attributes', {});
for k = 1:numel(items)
  at = fields(items(k).path);
  attributes = struct();
  for a = 1:size(items(k).attributes, 1)
    attributes.(field_of(items(k).attributes{a, 1})) = items(k).attributes{a, 2};
  end
  if ~items(k).is_group
    run = setfield(run, at{:}, items(k).value); %#ok<SFLD>
    info(end + 1) = told_of(items(k).path, at, attributes); %#ok<AGROW>
  elseif isempty(at)
    run = attributes;
  else
    run = setfield(run, at{:}, attributes); %#ok<SFLD>
  end
end
end

function [above, name] = above_and_name(path)
slash = find(path == '/', 1, 'last');
above = path(1:slash - 1);
if isempty(above)
  above = '/';
end
name = path(slash + 1:end);
end

function field = field_of(name)
field = matlab.lang.makeValidName(regexprep(name, '[^A-Za-z0-9_]+', '_'));
end

function one = told_of(path, at, attributes)
units = '';
if isfield(attributes, 'units')
  units = attributes.units;
end
one = struct('path', path, 'field', strjoin(at, '.'), 'units', units, 'attributes', attributes);
end
