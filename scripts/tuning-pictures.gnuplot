# Draws what tuning-pictures simulated. Variable: folder (of its files; tuning.png goes there, too).
set datafile separator ","
set datafile columnheaders
set terminal pngcairo size 1200,1300 font "sans,11" linewidth 1.5
set output folder."/tuning.png"
blue = "#4477aa"
red = "#ee6677"
green = "#228833"
file(name) = folder."/".name.".csv"
error_mrad(scale) = (column("setpoint_position_rad") - column("joint_position_rad")) * scale

set multiplot layout 3,1
set grid
set key right bottom
set ylabel "joint position, rad"
set xrange [0:0.2]
set title "Torque weight: the law alone, 0.1 rad at 20 °C" font ",13"
plot file("torque-1e-7") using "time_s":"joint_position_rad" with lines lc rgb green title "torque weight 1e-7", \
  file("torque-1e-6") using "time_s":"joint_position_rad" with lines lc rgb blue title "torque weight 1e-6", \
  file("torque-1e-5") using "time_s":"joint_position_rad" with lines lc rgb red title "torque weight 1e-5"

set ylabel "error (setpoint - position), mrad"
set yrange [-0.3:0.3]
set xrange [0:0.4]
set key right top
set title "What the daemon adds: end of the same move with an encoder of 320000 counts" font ",13"
plot file("law-alone") using "time_s":(error_mrad(1e3)) with lines lc rgb red title "law alone", \
  file("as-the-daemon") using "time_s":(error_mrad(1e3)) with lines lc rgb blue title "with observer, shaping, landing and rest"

set ylabel "error (setpoint - position), mrad"
set yrange [-1:10]
set xrange [0:3]
set xlabel "time, s"
set title "0.01 rad at -10 °C: end of the move" font ",13"
plot file("cold-pid") using "time_s":(error_mrad(1e3)) with lines lc rgb red title "PID of Zhao (2006)", \
  file("cold-c3") using "time_s":(error_mrad(1e3)) with lines lc rgb green title "temperature not used: C3", \
  file("cold-extended") using "time_s":(error_mrad(1e3)) with lines lc rgb blue title "temperature known: C4"
unset multiplot
