function group = h5info(file, name)
%H5INFO  Stands in for MATLAB's: the fields of its documentation that a reader needs, sizes in MATLAB's order.

items = stand_in_items(file, name);
paths = {items.path};
group = group_at(items, paths, name);
end

function group = group_at(items, paths, name)
below = name;
if ~strcmp(below, '/')
  below = [below '/'];
end
group = struct('Name', name, 'Groups', [], 'Datasets', [], 'Attributes', attributes_of(items(strcmp(paths, name))));
for k = find(strncmp(paths, below, numel(below)) & ~strcmp(paths, name))
  rest = paths{k}(numel(below) + 1:end);
  if any(rest == '/')
    continue
  elseif items(k).is_group
    group.Groups = [group.Groups; group_at(items, paths, paths{k})];
  else
    group.Datasets = [group.Datasets; dataset_of(items(k), rest)];
  end
end
end

function dataset = dataset_of(item, name)
type = 'H5T_FLOAT';
if ~isnumeric(item.value)
  type = 'H5T_STRING';
end
space = struct('Size', fliplr(size(item.value)), 'Type', 'simple');
if ischar(item.value)
  space = struct('Size', 1, 'Type', 'scalar');
elseif iscolumn(item.value) || (isempty(item.value) && size(item.value, 2) == 1)
  space.Size = size(item.value, 1);
end
dataset = struct('Name', name, 'Datatype', struct('Class', type), 'Dataspace', space, 'Attributes', attributes_of(item));
end

function list = attributes_of(item)
list = [];
for k = 1:size(item.attributes, 1)
  value = item.attributes{k, 2};
  type = 'simple';
  if ischar(value)
    type = 'scalar';
    value = {value};  % as of variable length
  end
  list = [list; struct('Name', item.attributes{k, 1}, 'Dataspace', struct('Type', type), 'Value', {value})];
end
end
