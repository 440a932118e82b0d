function value = h5read(file, path)
%H5READ  Stands in for MATLAB's: the first index of the file is the last one here, texts are cells.

persistent read items
if ~strcmp(read, file)
  items = stand_in_items(file, '/');
  read = file;
end
value = items(strcmp({items.path}, path)).value;
if ischar(value)
  value = {value};
elseif isnumeric(value)
  value = permute(value, ndims(value):-1:1);
  if isrow(value)
    value = value(:);
  end
end
end
