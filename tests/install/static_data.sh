#!/bin/sh
# static_data.sh PACKAGE: no object of the library can be written to. Constant tables that hold addresses (.data.rel.ro) are no state.
set -eu
package=$1
nm -A -f sysv "$(find "$package/moved" -name libpia.a)" |
    awk -F '|' '$NF ~ /^\.(data|bss|tdata|tbss)/ && $NF !~ /^\.data\.rel\.ro/ || $3 ~ /C/ { print; found = 1 } END { exit found }'
