# Draws what the demo recorded. Variables: record (CSV of strainwavectl export), picture (PNG to write).
set datafile separator ","
set datafile columnheaders
set terminal pngcairo size 1200,1300 font "sans,11" linewidth 1.5
set output picture
stats record using "utime" nooutput
start = STATS_min
time_s(dummy) = (column("utime") - start) * 1e-6
# At least 1: a logarithmic axis cannot show 0.
at_least_1(x) = x > 1 ? x : 1
error_urad(dummy) = at_least_1(abs(column("joint_position_rad") - column("setpoint_position_rad")) * 1e6)

set multiplot layout 4,1 title "A strain-wave joint tracks setpoints while its surroundings warm up" font ",14" \
  margins 0.09,0.97,0.05,0.94 spacing 0.0,0.035
set grid
set key top left
set format x ""
set xrange [0:*]

set ylabel "joint position, rad"
set logscale y
set yrange [1e-4:3]
plot record using (time_s(0)):(column("setpoint_position_rad")) with lines lw 3 lc rgb "#bbbbbb" title "setpoint", \
     record using (time_s(0)):(column("joint_position_rad")) with lines lc rgb "#1f5fa8" title "position"
unset logscale y

set ylabel "|error|, urad"
set logscale y
set yrange [1:1e4]
plot record using (time_s(0)):(error_urad(0)) with lines lc rgb "#b3262e" title "|position - setpoint|", \
     2 * pi / 320000 * 1e6 with lines dashtype 2 lc rgb "#888888" title "one encoder count"
unset logscale y

set ylabel "temperature, degC"
set yrange [-15:50]
plot record using (time_s(0)):(column("temperature_used_C")) with lines lc rgb "#d07a00" title "as the gains are scheduled by"

set ylabel "torque, N.m"
set xlabel "time, s"
set format x "%g"
set yrange [*:*]
plot record using (time_s(0)):(column("torque_commanded_Nm")) with lines lc rgb "#1f5fa8" title "commanded", \
     record using (time_s(0)):(column("torque_feedforward_Nm")) with lines lc rgb "#3a8f3a" title "friction and inertia feed-forward"
unset multiplot
