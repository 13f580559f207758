# Draws what temperature-picture simulated. Variable: folder (of move.dat; temperature.png goes there, too).
set encoding utf8
set terminal pngcairo size 900,480 font "sans,13" linewidth 2
set output folder."/temperature.png"
set title "Following error of the link during a move of 0.1 rad, simulated" font ",15"
set xlabel "temperature of the gear, °C"
set ylabel "RMS error, µrad"
set logscale y
set xrange [-11:75]
set yrange [5:10000]
set xtics (-10, 0, 10, 20, 30, 45)
set grid
unset key
of(way) = sprintf("< grep '^\"%s\"' %s/move.dat", way, folder)
plot of("none") using 2:3 with linespoints pt 7 lc rgb "#888888", \
  of("fixed friction") using 2:3 with linespoints pt 7 lc rgb "#cc8800", \
  of("disturbance observer") using 2:3 with linespoints pt 7 lc rgb "#b3262e", \
  of("scheduled and integral") using 2:3 with linespoints pt 7 lc rgb "#1f5fa8" lw 2, \
  of("none") every ::5 using 2:3:("no compensation") with labels left offset 1,0 tc rgb "#666666", \
  of("fixed friction") every ::5 using 2:3:("feed-forward for 30 °C") with labels left offset 1,0 tc rgb "#cc8800", \
  of("disturbance observer") every ::5 using 2:3:("disturbance observer") with labels left offset 1,0 tc rgb "#b3262e", \
  of("scheduled and integral") every ::5 using 2:3:("Strainwave") with labels left offset 1,0 tc rgb "#1f5fa8"
