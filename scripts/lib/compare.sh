# shellcheck shell=bash
# Comparison of two runs' path.csv. Sourced after common.sh.

# difference RUN OTHER: the largest difference in any column of path.csv, relative to the column's largest
# value, over all output points; "rows" where the numbers of points differ.
difference() {
  paste -d, "$1/path.csv" "$2/path.csv" | awk -F, '
    NR == 1 { n = NF / 2; next }
    { if (NF != 2 * n) { print "rows"; exit }
      for (i = 1; i < n; ++i) {
        if (($i == "") != ($(i + n) == "")) { print "rows"; exit }
        d = $i - $(i + n); if (d < 0) d = -d; if (d > worst[i]) worst[i] = d
        a = $i < 0 ? -$i : $i; if (a > size[i]) size[i] = a } }
    END { for (i = 1; i < n; ++i) if (size[i] > 0 && worst[i] / size[i] > all) all = worst[i] / size[i]
          printf "%.3g\n", all }' | head -n 1
}

# within DIFFERENCE BOUND: true where it is a number and not above the bound.
within() { [ "$1" != rows ] && awk -v d="$1" -v b="$2" 'BEGIN { exit !(d <= b) }'; }
