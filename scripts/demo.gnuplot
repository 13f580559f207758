# Draws what the demo recorded: each move of the three joints, from its first cycle. Variables: folder (of the demo's .dat files: ms since
# the order, share of the way, |error| in microradians), picture (PNG to write).
set encoding utf8
set terminal pngcairo size 1200,1300 font "sans,11" linewidth 1.5
set output picture
aware = "#1f5fa8"
blind = "#b3262e"
learned = "#3a8f3a"
way = "0.001 0.01 0.1 1"
shown_ms = "150 150 250 600"
at_least(least, x) = x > least ? x : least

set multiplot layout 4,2 title "One joint at -8 °C behind a gear's spring, with and without its temperature: motion of the link" font ",14" \
  margins 0.08,0.97,0.06,0.92 spacing 0.1,0.055
set grid
set xlabel "time since the order, ms" offset 0,0.5
do for [i = 1:4] {
  set xrange [0:word(shown_ms, i)]
  set yrange [-0.1:1.8]
  if (i == 1) { set key top left } else { unset key }
  set title "move by ".word(way, i)." rad" offset 0,-0.6
  set ylabel "link, share of the way"
  plot 1 with lines lc rgb "#bbbbbb" lw 2 title "target", \
       sprintf("%s/blind%d.dat", folder, i) using 1:2 with lines lc rgb blind title "temperature not known", \
       sprintf("%s/learned%d.dat", folder, i) using 1:2 with lines lc rgb learned title "not known, after five moves", \
       sprintf("%s/aware%d.dat", folder, i) using 1:2 with lines lc rgb aware title "temperature known"
  set xrange [0:2500]
  set yrange [1:3e6]
  set logscale y
  set format y "10^{%L}"
  if (i == 1) { set key top right } else { unset key }
  set title "its distance from the target" offset 0,-0.6
  set ylabel "|error|, µrad"
  plot 2 * 2 * pi / 320000 * 1e6 with lines dashtype 2 lc rgb "#888888" title "two counts of the encoder", \
       sprintf("%s/blind%d.dat", folder, i) using 1:(at_least(1, $3)) with lines lc rgb blind notitle, \
       sprintf("%s/learned%d.dat", folder, i) using 1:(at_least(1, $3)) with lines lc rgb learned notitle, \
       sprintf("%s/aware%d.dat", folder, i) using 1:(at_least(1, $3)) with lines lc rgb aware notitle
  unset logscale y
  set format y "%g"
}
unset multiplot
