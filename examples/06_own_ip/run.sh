#!/bin/sh
# Builds the design and its program, unless BUILD says where they are, and runs them.
set -e
[ -n "$BUILD" ] || { BUILD=build; cmake -S . -B build >&2; cmake --build build >&2; }
markervp map frame_counter --design "$BUILD/smooth.so"
markervp run demo --design "$BUILD/smooth.so" --output out/tlm
markervp run demo --design "$BUILD/smooth.so" --output out/clocked --fidelity clocked --quiet > /dev/null
markervp metrics summary.fps.mean --of out/clocked
