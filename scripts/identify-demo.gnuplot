# Draws what identify-demo measured. Variables: folder (of its files), T (a temperature), picture (PNG to write).
set datafile separator ","
set datafile columnheaders
set terminal pngcairo size 1200,900 font "sans,11" linewidth 1.5
set output picture
file(name) = folder."/".name.T.".csv"
stats file("catalogue") using "cycle" nooutput
catalogue_start = STATS_min
stats file("identified") using "cycle" nooutput
identified_start = STATS_min

set multiplot layout 2,1 title "Friction 30 % above the catalogue, ".T." °C: before and after identification" font ",14"
set grid
set offsets 0, 0, graph 0.05, 0
set key above horizontal center Left reverse # where no curve runs
set xrange [0:2]
set ylabel "joint position, rad"
plot file("identified") using ((column("cycle") - identified_start) * 1e-3):"joint_position_rad" with lines lc rgb "#4477aa" title "position, which is the same with either table at this scale"
set ylabel "error (setpoint - position), µrad"
set xlabel "time, s"
# Setpoint and position of a row are of the same period; rows whose message was lost do no harm.
plot file("catalogue") using ((column("cycle") - catalogue_start) * 1e-3):((column("setpoint_position_rad") - column("joint_position_rad")) * 1e6) with lines lc rgb "#ee6677" title "with the catalogue's table", \
  file("identified") using ((column("cycle") - identified_start) * 1e-3):((column("setpoint_position_rad") - column("joint_position_rad")) * 1e6) with lines lc rgb "#228833" title "with the identified table"
unset multiplot
