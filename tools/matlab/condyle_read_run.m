function [run, info] = condyle_read_run(file, group)
%CONDYLE_READ_RUN  A result file of condyle as a struct.
%
%   run = condyle_read_run(FILE) reads all of FILE: a run (sweep, fit, compare, laxity, simulate, calibrate) or a study.
%   run = condyle_read_run(FILE, GROUP) reads one group of it, '/sweep' or '/bands', and is that group. Of a study with
%   many samples '/bands' and '/indices' are small, '/samples' and '/outputs' are not.
%   [run, info] = condyle_read_run(...) tells units and full names of all datasets as well.
%
%   Fields have the names of the file, which docs/results.md lists with shapes and units:
%
%       run.sweep.value                            n x 1, what was swept (deg, mm or 1)
%       run.sweep.contacts.medial.force            n x 1, N
%       run.sweep.contacts.medial.point_moving     n x 3, mm
%       run.sweep.pose.rotation                    n x 3 x 3; of pose i squeeze(run.sweep.pose.rotation(i, :, :))
%       run.patches.medial_plateau.body            attributes of a group are fields like its datasets
%
%   - Shapes are those of docs/results.md, first index first (h5read alone turns them round). [n] is a column.
%   - All numbers are double. What is told by 1, 0 and -1 (not known) is a number, no logical. NaN and Inf stay.
%     Indices into other arrays count from 0, as in the file: triangles + 1 are rows of vertices, and of what has a
%     `first` the rows of pose i are first(i) + 1 : first(i + 1).
%   - Texts are row vectors of char, lists of texts columns of cells.
%   - In a name what is no letter, digit or _ becomes _ ('medial plateau': medial_plateau), and one that begins with a
%     digit gets an x in front; where two would be the same the later in the alphabet gets a number behind it. info
%     tells the name in the file.
%
%   info(k) of each dataset: path ('/sweep/contacts/medial/force'), field ('sweep.contacts.medial.force'), units, and
%   attributes, a struct; attributes.meaning of /sweep/status names what its numbers mean, from 0 on.
%
%   In MATLAB, R2016b or newer, h5info and h5read read the file. Octave has neither, and its load stops at the first
%   list of texts: there the program h5dump reads it (Debian: hdf5-tools; elsewhere it comes with HDF5), which has to be
%   found on the path. Tested under Octave 7.3; that both ways give the same struct is tested there with stand-ins for
%   h5info and h5read, not in MATLAB.
%
%   See also EXAMPLE_SWEEP, EXAMPLE_CONTACT_PATH, EXAMPLE_LAXITY, EXAMPLE_PRESSURE.

if nargin < 2
  group = '/';
end
if isstring(file)
  file = char(file);
end
if exist(file, 'file') ~= 2
  error('condyle:read_run', '%s: no such file, expected a result of condyle (HDF5)', file);
end
if exist('h5info', 'file') > 0 || exist('h5info', 'builtin') > 0
  items = items_by_h5info(file, group);
else
  items = items_by_h5dump(file, group);
end
[run, info] = struct_of_items(items, group);
end
