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
set key top right
set xrange [0:2]
set ylabel "joint position, rad"
plot file("identified") using ((column("cycle") - identified_start) * 1e-3):"joint_position_rad" with lines lc rgb "#4477aa" title "position"
set ylabel "error, µrad"
set xlabel "time, s"
# The reference of the cycle before: the drive has one period of delay.
before_1 = NaN
before_2 = NaN
error_1(position, reference) = (wanted = before_1, before_1 = reference, (position - wanted) * 1e6)
error_2(position, reference) = (wanted = before_2, before_2 = reference, (position - wanted) * 1e6)
plot file("catalogue") using ((column("cycle") - catalogue_start) * 1e-3):(error_1(column("joint_position_rad"), column("setpoint_position_rad"))) with lines lc rgb "#ee6677" title "with the catalogue's table", \
  file("identified") using ((column("cycle") - identified_start) * 1e-3):(error_2(column("joint_position_rad"), column("setpoint_position_rad"))) with lines lc rgb "#228833" title "with the identified table"
unset multiplot
