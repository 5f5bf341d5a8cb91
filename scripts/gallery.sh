#!/bin/sh
# gallery.sh PIA OUT: fits real data with the command PIA and writes the gallery into OUT: README.md and a picture of each fit. The commands on
# the page are those that ran, from the root of the sources.
set -eu
pia=$(realpath "$1") out=$2
mkdir -p "$out"
out=$(realpath "$out")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/bin"
ln -s "$pia" "$work/bin/pia"
ln -s "$(realpath data)" "$work/data"
PATH=$work/bin:$PATH
cd "$work"

# cell NAME: what a line of the fit's summary says.
cell() {
    sed -n "s/^$1  *//p" summary | sed 's/ (at the parameters)//' | head -n 1
}

# show NAME TITLE, then on standard input a sentence or several, an empty line, and the commands. The first fits; one draws NAME.png. What
# they print is on the page, but for seconds, which differ from run to run.
show() {
    name=$1 title=$2
    echo "$name" >&2
    cat >entry
    sed '/^$/q' entry >sentence
    sed '1,/^$/d' entry >commands
    sh -eu commands >printed 2>errors || { cat errors >&2; exit 1; }
    grep -v '^seconds ' printed >summary
    cp "$name.png" "$out/"
    points=$(sed -n '1s/^[a-z]*  *\([0-9]* points\).*/\1/p' summary)
    echo "| [$title](#$name) | $points | $(cell model) | $(cell 'max error') | $(cell 'rms error') |" >>rows
    {
        printf '\n<a id="%s"></a>\n\n## %s\n\n' "$name" "$title"
        cat sentence
        printf '![%s](%s.png)\n\n```sh\n' "$title" "$name"
        cat commands
        printf '```\n\n```text\n'
        cat summary
        printf '```\n'
    } >>sections
}

show airfoil 'An airfoil, into CAD' <<'END'
RAE 2822, a transonic airfoil, to a ten-thousandth of its chord: few control points suffice, most of them where the nose bends. The STEP file holds the very spline. The comb shows the curvature that the air will feel.

pia fit data/airfoil/rae2822.dat --tolerance 1e-4 -o airfoil.json -o airfoil.step
pia plot airfoil.json data/airfoil/rae2822.dat --comb --title 'RAE 2822' --size 960x420 -o airfoil.png --quiet
END

show glyph 'A letter, its corners kept' <<'END'
The letter g of DejaVu Serif, from evenly spaced points of its outline in units of 1/2048 of the type size. Corners are found and kept sharp, both
contours close without a seam, and the tolerance is one unit.

pia fit data/glyph/dejavuserif_g_outline.csv --closed --corners auto --tolerance 1 -o glyph.json --quiet
pia plot glyph.json data/glyph/dejavuserif_g_outline.csv --title 'g of DejaVu Serif' --size 960x820 -o glyph.png --quiet
END

show coast 'A coastline' <<'END'
Great Britain, 18,641 points of longitude and latitude. To a hundredth of a degree, a kilometre at most, every
headland is where it was.

pia fit data/coast/greatbritain_wdb2.csv --closed --tolerance 0.01 -o coast.json --quiet
pia plot coast.json data/coast/greatbritain_wdb2.csv --no-control --no-knots --title 'Great Britain' --size 960x900 -o coast.png --quiet
END

show gps 'A walk with outliers' <<'END'
A walk up a mountain as the receiver wrote it, in longitude and latitude. Jumps of the receiver get no weight in the robust fit; the report
counts them.

pia fit data/gps/mojstrovka.csv --columns 2,3 --control 60 --robust tukey -o gps.json
pia plot gps.json data/gps/mojstrovka.csv --columns 2,3 --no-control --no-knots --title 'Mojstrovka' --size 960x760 -o gps.png --quiet
END

show ecg 'Five seconds of a heart' <<'END'
An electrocardiogram as a function of time, to 0.04 mV. Knots crowd where the heart beats and are spared where it rests.

pia fit data/series/ecg208_5s.csv --fit-function --tolerance 0.04 -o ecg.json
pia plot ecg.json data/series/ecg208_5s.csv --no-control --title 'ECG, record 208' --size 960x420 -o ecg.png --quiet
END

show terrain 'Terrain' <<'END'
The Front Range of Colorado, 144 x 144 heights of the shuttle mission, to 50 m everywhere: one bicubic surface, in STEP
one face.

pia fit data/dem/srtm_colorado_144x144.asc --tolerance 50 -o terrain.json -o terrain.step
pia plot terrain.json --no-control --no-knots --title 'Front Range, Colorado' --view -60,40 --size 960x720 -o terrain.png --quiet
END

show owl 'An owl' <<'END'
The face of a statuette, scanned: 10,201 depths, to half a millimetre. The colours are what is left at every point: the rims of the eyes and the
sides of the beak are what is hard.

pia fit data/scan/owl_face_101x101.csv --columns u,depth,v --grid 101x101 --tolerance 0.5 -o owl.json
pia plot owl.json data/scan/owl_face_101x101.csv --columns u,depth,v --grid 101x101 --no-control --no-knots --title Owl --view 70,15 \
    --size 860x820 -o owl.png --quiet
END

show face 'A face with holes' <<'END'
A range image of a face, of which 223 points were taken out: around both eyes and on the chin. Fairing bends the surface as little as the points
around the holes allow. The picture and the second report compare it with all points, those that were never seen included: on
a face 0.15 high no point is missed by 0.006.

awk -F, -v OFS=, 'NR > 1 { i = int((NR - 2) / 49); j = (NR - 2) % 49
    if ((i - 14)^2 + (j - 30)^2 < 26 || (i - 31)^2 + (j - 30)^2 < 26 || (i - 23)^2 + (j - 14)^2 < 20) $1 = $2 = $3 = "nan" } 1' \
    data/scan/face_fran_45x49.csv >holes.csv
pia fit holes.csv --columns x,z,y --grid 45x49 --control 24,26 --fairing 0.1 -o face.json
pia check face.json data/scan/face_fran_45x49.csv --columns x,z,y --grid 45x49
pia plot face.json data/scan/face_fran_45x49.csv --columns x,z,y --grid 45x49 --no-control --no-knots --title 'A face' --view=-60,20 \
    --size 760x820 -o face.png --quiet
END

show protein 'The backbone of a protein' <<'END'
Lysozyme: a cubic through the C-alpha atom of every residue, as ribbons are drawn. Nothing is asked for but the curve, so it passes through all
129 of them, to rounding.

pia fit data/curve3d/lysozyme_2LYZ_ca.csv --columns x,y,z -o protein.json
pia plot protein.json data/curve3d/lysozyme_2LYZ_ca.csv --columns x,y,z --no-control --no-knots --no-deviation --title 'Lysozyme' \
    --view 30,20 --size 860x800 -o protein.png --quiet
END

show toolpath 'A tool path' <<'END'
One pass of a ball nose through a pocket, 2607 short moves of a G-code file. One spline stays within 0.02 mm of every end point, without the
stop and go of the moves.

pia fit data/curve3d/tball_pass.csv --tolerance 0.02 -o toolpath.json -o toolpath.step
pia plot toolpath.json data/curve3d/tball_pass.csv --no-control --no-knots --title 'Pocket' --size 960x680 -o toolpath.png --quiet
END

show trimmed 'A scan without order, to a trimmed face' <<'END'
The points of the face, shuffled: to 0.002 as a true distance, trimmed where they end. The picture is drawn from the STEP file as OpenCASCADE reads it.

tail -n +2 data/scan/face_fran_45x49.csv | shuf --random-source=data/dem/jacksboro_344x403.pgm >cloud.csv
pia fit cloud.csv --columns 1,3,2 --surface --tolerance 0.002 --measure distance -o trimmed.step --report trimmed.html
pia plot trimmed.step --no-control --no-knots --title 'A trimmed face' --view=-60,15 --size 760x820 -o trimmed.png --quiet
END

# The report, view by view: its figure alone, in a window of its size.
view() { # NAME REPORT SIZE HASH
    sed 's|</head>|<style>#stage{position:fixed;inset:0;z-index:9}.canvas{height:100vh}.legend{position:absolute;inset:8px 10px auto auto;width:220px}</style></head>|' "$2" >alone.html
    echo "report_$1" >&2
    "$chromium" --headless --no-sandbox --disable-gpu --enable-unsafe-swiftshader --disable-quic --no-first-run --disable-background-networking \
        --disable-component-update --disable-sync --hide-scrollbars --force-color-profile=srgb --user-data-dir="$work/profile" --window-size="$3" \
        --run-all-compositor-stages-before-draw --virtual-time-budget=8000 --screenshot="$out/report_$1.png" \
        "file://$work/alone.html#theme=light&$4" 2>errors || { cat errors >&2; exit 1; }
}
chromium=$(command -v chromium || command -v chromium-browser)
pia fit data/airfoil/rae2822.dat --tolerance 1e-4 --report curve.html --quiet >/dev/null
view deviation_bars curve.html 940,360 'show=points+knots+bars'
view comb curve.html 940,420 'show=comb+knots&view=0.34,0,0.75'
for mode in shaded deviation zebra isophotes gaussian mean; do
    view "$mode" trimmed.html 540,540 "mode=$mode&show=edges&view=-62,14,0.95"
done
cat >>sections <<'END'

<a id="report"></a>

## The report, view by view

`--report FILE.html` writes a page of its own ([report.md](../report.md)). Its figure shows the airfoil with its deviation, drawn longer, and with its curvature comb:

```sh
pia fit data/airfoil/rae2822.dat --tolerance 1e-4 --report curve.html
```

![Airfoil with deviation bars](report_deviation_bars.png)

![Airfoil with its curvature comb](report_comb.png)

and the trimmed face above in each of its ways:

| shaded | deviation |
| --- | --- |
| ![Shaded surface](report_shaded.png) | ![Deviation of the surface in colours](report_deviation.png) |
| **zebra stripes** | **isophotes** |
| ![Zebra stripes](report_zebra.png) | ![Isophotes](report_isophotes.png) |
| **Gaussian curvature** | **mean curvature** |
| ![Gaussian curvature](report_gaussian.png) | ![Mean curvature](report_mean.png) |
END

{
    cat <<'END'
# Gallery

Eleven fits of real data, each with its command, its picture and what the command said. `./run gallery` makes this page again; where the data
come from is told in [data/README.md](../../data/README.md). Errors are in the units of the points. [The views of the report](#report) are at the end.

| fit | points | model | largest error | rms error |
| --- | --- | --- | --- | --- |
END
    cat rows sections
} >"$out/README.md"
