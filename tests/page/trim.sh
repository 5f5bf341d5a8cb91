#!/bin/sh
# trim.sh MODEL.json: the model of one surface with an outer loop and a hole, in geomdl's layout, on standard output.
circle() {
    awk -v r="$1" -v turn="$2" 'BEGIN { for (i = 0; i <= 48; i++) { a = turn * i * 3.14159265358979 / 24; printf "%s[%.9g, %.9g]", i ? ", " : "", 0.5 + r * cos(a), 0.5 + r * sin(a) } }'
}
knots=$(awk 'BEGIN { printf "0, 0"; for (i = 1; i < 48; i++) printf ", %.9g", i / 48; printf ", 1, 1" }')
loop() { printf '{"type": "spline", "rational": false, "dimension": 2, "degree": 1, "knotvector": [%s], "control_points": {"points": [%s]}, "reversed": %s}' "$knots" "$(circle "$1" "$2")" "$3"; }
trims="\"trims\": {\"count\": 2, \"data\": [$(loop 0.46 1 1), $(loop 0.16 -1 0)]}"
sed "0,/\"type\": \"spline\"/s//&, $trims/" "$1"
