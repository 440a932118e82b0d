function style = line_style(k)
%LINE_STYLE  Kinds of lines, so that curves can be told apart without colours.

styles = {'-', '--', '-.'};
style = styles{mod(k - 1, numel(styles)) + 1};
end
