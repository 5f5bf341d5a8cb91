#!/bin/sh
# by_pkg_config.sh CONSUMER PACKAGE KIND: the same program, built against the moved package with the flags of pkg-config.
set -eu
consumer=$1 package=$2 kind=$3
PKG_CONFIG_PATH=$(find "$package/moved" -name pkgconfig -type d)
export PKG_CONFIG_PATH
all=
[ "$kind" = shared ] || all=--static
[ "$(pkg-config --variable=prefix pia | xargs realpath)" = "$(realpath "$package/moved")" ]
gcc -std=c11 -Wall -Wextra -Werror "$consumer/consumer.c" $(pkg-config $all --cflags --libs pia) -o "$package/consumer_pkg_config"
LD_LIBRARY_PATH=$(pkg-config --variable=libdir pia) "$package/consumer_pkg_config"
