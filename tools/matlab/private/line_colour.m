function colour = line_colour(k)
%LINE_COLOUR  Colours that differ for colour-blind readers too [Okabe and Ito 2008].

colours = [0 114 178; 213 94 0; 0 158 115; 204 121 167; 86 180 233; 230 159 0; 0 0 0] / 255;
colour = colours(mod(k - 1, size(colours, 1)) + 1, :);
end
