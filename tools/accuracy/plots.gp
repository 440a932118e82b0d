# Plots of the accuracy study; `folder` is where its tables are.
set datafile separator ","
set terminal pngcairo size 900,600 font "DejaVu Sans,12" enhanced
set grid lc rgb "#dddddd" lt 1
set border 3 lc rgb "#444444"
set tics nomirror
set logscale y
set format y "10^{%T}"

set output folder."/convergence.png"
set title "Newton's method from the pose five degrees before" left
set xlabel "iterations"
set ylabel "pose error (|Δa|/L, angle)"
set yrange [1e-17:1]
plot folder."/convergence.csv" every ::1 using 1:2 with linespoints lw 2 pt 7 lc rgb "#0072b2" title "largest of 18 poses", \
     "" every ::1 using 1:3 with linespoints lw 2 pt 6 lc rgb "#d55e00" title "median"

set output folder."/solvers.png"
set title "Error against time of one pose, two contacts and eight ligaments" left
set xlabel "time per pose [µs]"
set logscale x
set xrange [1:*]
set key outside right
plot folder."/tolerance.csv" every ::1 using 4:2 with linespoints lw 2 pt 7 lc rgb "#0072b2" title "ours, tolerance 10^{-2} to 10^{-13}", \
     folder."/solvers.csv" every ::2 using 6:5 with points pt 13 ps 2 lc rgb "#d55e00" title "others", \
     "" every ::2 using 6:5:1 with labels offset 0,1 font ",9" notitle
