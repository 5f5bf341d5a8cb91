#!/bin/sh
# by_find_package.sh CONSUMER PACKAGE: a program of ten lines, built against the moved package by CMake.
set -eu
consumer=$1 package=$2
build=$package/consumer_cmake
rm -rf "$build"
cmake -S "$consumer" -B "$build" -G Ninja -DCMAKE_PREFIX_PATH="$package/moved"
cmake --build "$build"
"$build/consumer"
