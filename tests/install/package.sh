#!/bin/sh
# package.sh SOURCE PACKAGE SHARED: builds with BUILD_SHARED_LIBS=SHARED, installs, and moves the tree to PACKAGE/moved. The plug-in, where
# it can be had, comes with the shared kind.
set -eu
source=$1 package=$2 shared=$3
plugin=OFF
[ "$shared" = 0 ] || plugin=AUTO
rm -rf "$package/installed" "$package/moved"
cmake -S "$source" -B "$package/build" -G Ninja -DBUILD_SHARED_LIBS="$shared" -DPIA_BUILD_TESTS=OFF -DPIA_WITH_OCCT=$plugin \
    -DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_FLAGS_DEBUG=-O0 -DCMAKE_INSTALL_PREFIX="$package/installed"
cmake --build "$package/build"
cmake --install "$package/build"
mv "$package/installed" "$package/moved"
