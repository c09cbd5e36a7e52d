#!/bin/sh
# Compiles the applications as for a board, unless BUILD says where they are, and runs them.
set -e
[ -n "$BUILD" ] || { BUILD=build; cmake -S . -B build >&2; cmake --build build >&2; }
markervp run --linux "$BUILD/gpio" --output out/gpio
markervp run --linux "$BUILD/features" --output out/features
