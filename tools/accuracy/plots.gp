# Plots of the accuracy study; `folder` is where its tables are.
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

set output folder."/convergence.png"
set title "Newton's method from the pose five degrees before"
set xlabel "iterations"
set ylabel "pose error (|Δa|/L, angle)"
set yrange [1e-17:1]
plot folder."/convergence.csv" every ::1 using 1:2 with linespoints lw 2 pt 7 lt 1 title "largest of 18 poses", \
     "" every ::1 using 1:3 with linespoints lw 2 pt 6 lt 2 title "median"

name(row) = system(sprintf("sed -n %dp '%s/solvers.csv' | cut -d'\"' -f2", row + 1, folder))
rows = int(system(sprintf("wc -l < '%s/solvers.csv'", folder))) - 1

set output folder."/solvers.png"
set title "Error against time of one pose: two contacts, eight ligaments"
set xlabel "time per pose [µs]"
set logscale x
set xrange [1:1000]
set key inside top right
plot folder."/tolerance.csv" every ::1 using 4:2 with linespoints lw 2 pt 7 lt 1 \
       title "ours, Newton alone, tolerance 10^{-2} to 10^{-13}", \
     for [row=2:rows] folder."/solvers.csv" every ::row::row using 6:5 with points pt 2*row+1 ps 2 lt row-1 title name(row)
