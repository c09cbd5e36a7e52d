#!/bin/sh
# Builds the program, unless BUILD says where it is built, and runs it.
set -e
[ -n "$BUILD" ] || { BUILD=build; cmake -S . -B build >&2; cmake --build build >&2; }
markervp run --program "$BUILD/first.so" --output out
