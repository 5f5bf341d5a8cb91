#!/bin/sh
# bundle.sh ROOT: the committed page corresponds to its sources in web/.
root=$1
command -v node >/dev/null || { echo 'skipped: there is no node'; exit 77; }
[ -d "$root/web/node_modules/esbuild" ] && [ -d "$root/web/node_modules/three" ] || { echo 'skipped: ./run web has not been run here'; exit 77; }
node "$root/web/build.mjs" --check
