#!/bin/sh
# damaged.sh PIA: whatever a CAD file is like, the answer is a model or one line of error, never a crash. Without the plug-in that line
# names what to install.
set -eu
pia=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
printf '0 0 0\n1 2 0\n2 1 1\n3 3 0\n4 0 1\n' >p.xyz
"$pia" fit p.xyz --quiet -o whole.step -o whole.igs >/dev/null

answers() { # FILE: read, or refused in one line with status 3
    status=0
    "$pia" info "$1" >out 2>error || status=$?
    case $status in
    0) ;;
    3) test "$(wc -l <error)" -eq 1 && grep -q "^pia: $1: " error || { cat error; exit 1; } ;;
    *) echo "$1: status $status"; cat error; exit 1 ;;
    esac
}

for file in whole.step whole.igs; do
    kind=${file#whole.}
    size=$(wc -c <"$file")
    for share in 0 10 50 70 90 99; do
        head -c $((size * share / 100)) "$file" >"cut$share.$kind"
        answers "cut$share.$kind"
    done
    sed 's/[0-9][0-9]*/999999999999999999/7' "$file" >"huge.$kind"
    sed 's/#[0-9]*=/#1=/; s/(#/(#9/g' "$file" >"astray.$kind"
    tr '0123456789' '9876543210' <"$file" >"digits.$kind"
    head -c 3000 /dev/urandom >"noise.$kind"
    for name in huge astray digits noise; do answers "$name.$kind"; done
done
head -c 3000 /dev/urandom >noise.brep
answers noise.brep

# A copy of the program that stands alone.
cp "$pia" alone
status=0
PIA_PLUGIN_PATH='' ./alone info whole.step >out 2>error || status=$?
grep -q 'libocct-data-exchange-dev' error || { echo "status $status"; cat error; exit 1; }
"$pia" info - --format step <whole.step >out
grep -q 'degree 3, 5 control points' out
echo "every damaged file was answered"
