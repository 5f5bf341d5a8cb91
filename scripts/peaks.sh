#!/bin/sh
# peaks.sh N: rows x,y,z of the peaks function on an N x N lattice of [-3,3]^2, y slow, x fast: what [2004] fits for its Fig. 6.
set -eu
awk -v n="${1:-11}" 'BEGIN {
    print "x,y,z"
    for (i = 0; i < n; i++)
        for (j = 0; j < n; j++) {
            x = 6 * j / (n - 1) - 3
            y = 6 * i / (n - 1) - 3
            z = 3 * (1 - x) ^ 2 * exp(-x ^ 2 - (y + 1) ^ 2) - 10 * (x / 5 - x ^ 3 - y ^ 5) * exp(-x ^ 2 - y ^ 2) - exp(-(x + 1) ^ 2 - y ^ 2) / 3
            printf "%.17g,%.17g,%.17g\n", x, y, z
        }
}'
