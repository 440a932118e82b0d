# Plots of the accuracy study; `folder` is where its tables are. What was not measured is not drawn.
is_there(name) = system(sprintf("test -f '%s/%s.csv' && echo 1 || echo 0", folder, name)) + 0
set datafile separator ","
set terminal pngcairo size 900,560 font "DejaVu Sans,12" enhanced
set linetype 1 lc rgb "#0072b2"
set linetype 2 lc rgb "#d55e00"
set linetype 3 lc rgb "#009e73"
set linetype 4 lc rgb "#cc79a7"
set linetype 5 lc rgb "#000000"
set grid lc rgb "#dddddd" lt 1
set border 3 lc rgb "#444444"
set tics nomirror
set logscale y
set format y "10^{%T}"
set key samplen 2 opaque

if (is_there("convergence")) {
set output folder."/images/accuracy_convergence.png"
set title "Newton's method from the pose five degrees before"
set xlabel "iterations"
set ylabel "pose error (|Δa|/L, angle)"
set yrange [1e-17:1]
plot folder."/convergence.csv" every ::1 using 1:2 with linespoints lw 2 pt 7 lt 1 title "largest of 18 poses", \
     "" every ::1 using 1:3 with linespoints lw 2 pt 6 lt 2 title "median"

name(row) = system(sprintf("sed -n %dp '%s/solvers.csv' | cut -d'\"' -f2", row + 1, folder))
rows = int(system(sprintf("wc -l < '%s/solvers.csv'", folder))) - 1

set output folder."/images/accuracy_solvers.png"
set title "Error against time of one pose: two contacts, eight ligaments"
set xlabel "time per pose [µs]"
set logscale x
set xrange [1:2000]
set key inside top right
plot folder."/tolerance.csv" every ::1 using 4:2 with linespoints lw 2 pt 7 lt 1 \
       title "ours, Newton alone, tolerance 10^{-2} to 10^{-13}", \
     for [row=2:rows] folder."/solvers.csv" every ::row::row using 6:5 with points pt 2*row+1 ps 2 lt row-1 title name(row)
}

if (is_there("whole_way")) {
# Only the rows of one group: others are not numbers, and not drawn.
way(group, column) = strcol(1)[1:strlen(group)] eq group ? column : NaN
groups = "resolution|control points|roughness|smoothing|exact"
titles = "mesh without roughness|knots 1.4 to 8 mm apart|roughness 0.02 to 0.2 mm|smoothing, 0.2 mm|one bone exact, 0.2 mm"
piece(text, i) = system(sprintf("echo '%s' | cut -d'|' -f%d", text, i))
set output folder."/images/accuracy_whole_way.png"
set terminal pngcairo size 1200,560 font "DejaVu Sans,12" enhanced
set multiplot layout 1,2 title "From mesh to pose: root mean square errors, against the exact phantom"
unset title
set xlabel "surfaces from the exact ones [mm]"
set format y "%g"
set format x "%g"
set logscale xy
set xrange [0.0003:0.5]
set yrange [0.0001:2]
set ylabel "translation [mm]"
set key bottom right Left reverse
set arrow 1 from graph 0,first 0.1 to graph 1,first 0.1 nohead dt 2 lc rgb "#444444"
plot for [i=1:5] folder."/whole_way.csv" every ::1 using 7:(way(piece(groups, i), $10)) with points pt 2*i+3 ps 1.4 lw 1.5 lt i title piece(titles, i)
set ylabel "rotation [°]"
unset key
plot for [i=1:5] folder."/whole_way.csv" every ::1 using 7:(way(piece(groups, i), $12)) with points pt 2*i+3 ps 1.4 lw 1.5 lt i notitle
unset multiplot
}
