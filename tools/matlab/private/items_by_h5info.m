function items = items_by_h5info(file, group)
%ITEMS_BY_H5INFO  Groups and datasets of an HDF5 file, by MATLAB's own functions.
%
%   items: struct array with path, is_group, value (of datasets: shape as in the file, first index first) and
%   attributes (n x 2 cell of names and texts), those of a group before what is in it.

try
  top = h5info(file, group);
catch problem
  error('condyle:read_run', '%s: %s cannot be read: %s', file, group, problem.message);
end
items = items_of_group(file, top);
end

function items = items_of_group(file, group)
name = group.Name;
if strcmp(name, '/')
  name = '';
end
parts = {item(group.Name, true, [], group.Attributes)};
for k = 1:numel(group.Datasets)
  dataset = group.Datasets(k);
  path = [name '/' dataset.Name];
  parts{end + 1} = item(path, false, value_of(file, path, dataset), dataset.Attributes); %#ok<AGROW>
end
for k = 1:numel(group.Groups)
  parts{end + 1} = items_of_group(file, group.Groups(k)); %#ok<AGROW>
end
items = [parts{:}];
end

function value = value_of(file, path, dataset)
shape = fliplr(dataset.Dataspace.Size(:)');  % in the order of the file
texts = strcmp(dataset.Datatype.Class, 'H5T_STRING');
scalar = strcmp(dataset.Dataspace.Type, 'scalar');
if ~scalar && any(shape == 0)
  value = zeros([shape ones(1, 2 - numel(shape))]);
  if texts
    value = cell(size(value));
  end
  return
end
value = h5read(file, path);
if texts
  value = texts_of(value, scalar);
elseif numel(shape) > 1
  value = double(permute(value, numel(shape):-1:1));
else
  value = double(value(:));
end
end

function value = texts_of(value, scalar)
if isstring(value)
  value = cellstr(value);
elseif ischar(value)
  value = {value};
end
value = value(:);
if scalar
  value = value{1};
end
end

function one = item(path, is_group, value, attributes)
list = cell(numel(attributes), 2);
for k = 1:numel(attributes)
  scalar = ~isfield(attributes(k), 'Dataspace') || strcmp(attributes(k).Dataspace.Type, 'scalar');
  text = attributes(k).Value;
  if ~isnumeric(text)
    text = texts_of(text, scalar);
  end
  list(k, :) = {attributes(k).Name, text};
end
one = struct('path', path, 'is_group', is_group, 'value', {value}, 'attributes', {list});
end
