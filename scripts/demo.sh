#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Demonstrates libph on real data: the barcode of a point set, the barcode of a volume, and an RGB-D
# frame cut into objects. Installs missing packages, builds and runs the programs, and lists the
# files in out/.
set -euo pipefail
cd "$(dirname "$0")/.."
out=out
mkdir -p "$out"

scripts/setup.sh build demo
cmake --preset release -DPH_BUILD_TESTS=OFF -DPH_BUILD_EXAMPLES=OFF >"$out/build.log"
cmake --build --preset release -j "$(nproc)" >>"$out/build.log" || { cat "$out/build.log"; exit 1; }
barcode=build/release/apps/barcode/ph-barcode
segment=build/release/apps/segment/ph-segment
/usr/bin/python3 scripts/demo_data.py "$out/data"

# These functions print the options for report pages, or nothing if the pages are not built in.
report() { :; }
with_cells() { :; }
if $barcode --version --verbose | grep -q '^reports *built in'; then
  report() { printf -- '--report %s' "$out/$1.html"; }
  with_cells() { printf -- '--representatives %s' "$1"; }  # the report draws the cells on the data
else
  echo "no pages to look at: npm could not install what bundles them; see $out/build.log"
fi

# longest DIM FILE.csv: prints the five longest bars of a dimension.
longest() {
  awk -F, -v dim="$1" '$1 == dim { printf "%.4g [%.4g, %.4g)\n", $3 - $2, $2, $3 }' "$2" |
    sort -gr | sed -n '1,5s/^/    /p'
}

echo
echo "1. 5 210 points on a cat (libcgal-demo): Vietoris-Rips, H0 and H1"
$barcode "$out/data/kitten.csv" --threshold 0.15 --quiet -o "$out/kitten.csv" \
  --plot "$out/kitten.svg" --plot-kind diagram $(report kitten) $(with_cells cycles)
echo "   longest loops, length [birth, death): two stand out, as on a torus"
longest 1 "$out/kitten.csv"

echo "2. CT of a skull, 64 x 64 x 64 (libcgal-demo): cubical, H0, H1, H2"
$barcode "$out/data/skull.npy" --quiet -o "$out/skull.csv" --plot "$out/skull.svg" --plot-kind barcode \
  $(report skull) $(with_cells voxels)
echo "   longest voids, length [birth, death)"
longest 2 "$out/skull.csv"

echo "3. RGB-D frame Motorcycle (python3-skimage): objects by persistence of components"
$segment --depth "$out/data/depth.png" --color "$out/data/color.png" \
  --intrinsics 994.978,994.978,311.193,254.877 --max-range 4 \
  -o "$out/motorcycle.ply" --labels "$out/motorcycle_labels.png" --json "$out/motorcycle.json" \
  --plot "$out/motorcycle.svg" --picture "$out/motorcycle.png" $(report motorcycle) 2>&1 | sed 's/^/   /'

echo
echo "written:"
echo "  $out/motorcycle.png         the picture with its objects coloured"
echo "  $out/motorcycle.ply         every point with its label; motorcycle.json: the numbers"
echo "  $out/kitten.svg, skull.svg  persistence diagram and barcode; .csv: all bars"
if [ -n "$(report any)" ]; then
  echo "  $out/motorcycle.html, kitten.html, skull.html   open them in a browser: cloud, barcode, diagram"
  echo "                              and merge tree, linked; a slider cuts the motorcycle anew"
fi
