function items = items_by_h5dump(file, group)
%ITEMS_BY_H5DUMP  Groups and datasets of an HDF5 file, by the program h5dump: for Octave.
%
%   items: as of items_by_h5info.

selection = '';
if ~strcmp(group, '/')
  selection = ['-g ' quoted(group) ' '];
end
file = make_absolute_filename(file);
nowhere = '/dev/null';
if ispc()
  nowhere = 'NUL';
end
% All digits, texts escaped and in one line each, no indices.
[status, text] = system(['h5dump -e -y -w 0 -m "%.17g" ' selection quoted(file) ' 2>' nowhere]);
if status == 127
  error('condyle:read_run', 'h5dump is not found, expected it on the path (Debian: hdf5-tools)');
elseif status ~= 0
  error('condyle:read_run', '%s: %s cannot be read, expected a whole HDF5 file that has it', file, group);
end
items = items_of_text(text);
end

function word = quoted(word)
if ispc()
  word = ['"' word '"'];
else
  word = ['''' strrep(word, '''', '''\''''') ''''];
end
end

function items = items_of_text(text)
% Lines of structure begin with a capital or a brace; numbers and quoted texts do not.
[from, to, words] = regexp(text, '^ *(GROUP|DATASET|ATTRIBUTE|DATATYPE|DATASPACE|DATA|\})[^\n]*$', 'start', 'end', 'tokens', 'lineanchors');
items = struct('path', {}, 'is_group', {}, 'value', {}, 'attributes', {});
open = struct('kind', {}, 'path', {}, 'name', {}, 'item', {});
texts = false;
shape = [];
for k = 1:numel(from)
  line = text(from(k):to(k));
  word = words{k}{1};
  switch word
    case {'GROUP', 'DATASET'}
      path = path_below(open, name_of(line));
      items(end + 1) = struct('path', path, 'is_group', word(1) == 'G', 'value', [], 'attributes', {cell(0, 2)});
      open(end + 1) = struct('kind', word, 'path', path, 'name', '', 'item', numel(items));
    case 'ATTRIBUTE'
      open(end + 1) = struct('kind', word, 'path', '', 'name', name_of(line), 'item', open(end).item);
    case 'DATATYPE'
      texts = ~isempty(strfind(line, 'H5T_STRING'));
      if line(end) == '{'
        open(end + 1) = struct('kind', word, 'path', '', 'name', '', 'item', 0);
      end
    case 'DATASPACE'
      shape = shape_of(line);
    case 'DATA'
      value = value_of(text(to(k) + 1:from(k + 1) - 1), texts, shape);
      if strcmp(open(end).kind, 'ATTRIBUTE')
        items(open(end).item).attributes(end + 1, :) = {open(end).name, value};
      else
        items(open(end).item).value = value;
      end
      open(end + 1) = struct('kind', word, 'path', '', 'name', '', 'item', 0);
    case '}'
      if ~isempty(open)
        open(end) = [];
      end
  end
end
end

function name = name_of(line)
quotes = find(line == '"');
name = line(quotes(1) + 1:quotes(end) - 1);
end

function path = path_below(open, name)
if isempty(open)
  path = name;  % absolute
elseif strcmp(open(end).path, '/')
  path = ['/' name];
else
  path = [open(end).path '/' name];
end
end

function shape = shape_of(line)
% "SIMPLE { ( 25, 3 ) / ( 25, 3 ) }", or "SCALAR": an empty shape.
shape = [];
size = regexp(line, '{ \(([^)]*)\)', 'tokens', 'once');
if ~isempty(size)
  shape = sscanf(size{1}, '%d,')';
end
end

function value = value_of(text, texts, shape)
if texts
  value = texts_of(text);
  if isempty(shape)
    value = value{1};
    return
  end
else
  value = sscanf(text, '%f,');
end
if numel(value) ~= prod(shape)
  error('condyle:read_run', 'h5dump gave %d values, expected %d', numel(value), prod(shape));
end
value = reshape(value, [fliplr(shape) ones(1, 2 - numel(shape))]);
if numel(shape) > 1
  value = permute(value, numel(shape):-1:1);
elseif isempty(value)
  value = reshape(value, 0, 1);
end
end

function list = texts_of(text)
lines = strtrim(strsplit(strtrim(text), "\n"));
if isequal(lines, {''})
  lines = {};
end
list = cell(numel(lines), 1);
for k = 1:numel(lines)
  quotes = find(lines{k} == '"');
  list{k} = unescaped(lines{k}(quotes(1) + 1:quotes(end) - 1));
end
end

function text = unescaped(text)
if ~any(text == '\')
  return
end
parts = strsplit(text, '\\\\', 'CollapseDelimiters', false);
for k = 1:numel(parts)
  % Bytes beyond ASCII are octal, of some versions of h5dump with the sign in front.
  [codes, pieces] = regexp(parts{k}, '\\(?:37777777)?([0-7]{3})', 'tokens', 'split');
  for c = 1:numel(codes)
    pieces{c} = [pieces{c} char(mod(base2dec(codes{c}{1}, 8), 256))];
  end
  part = [pieces{:}];
  part = strrep(strrep(strrep(part, '\n', "\n"), '\t', "\t"), '\r', "\r");
  parts{k} = strrep(part, '\"', '"');
end
text = strjoin(parts, '\\');
end
