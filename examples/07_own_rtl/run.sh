#!/bin/sh
# Builds one IP from RTL, unless BUILD says where it is, and puts it in the place of its model.
set -e
[ -n "$BUILD" ] || { BUILD=build; cmake -S . -B build >&2; cmake --build build --target corner_detection >&2; }
markervp run demo --quiet --no-report --output out/model > /dev/null
markervp run demo --quiet --no-report --output out/rtl --set "pl.fidelity.corner_detection=$BUILD/corner_detection.so" > /dev/null
for metric in frames.counts.corners.mean summary.fps.mean frames.error.translation_mm.mean; do
  markervp metrics $metric --of out/model | tail -n 1
  markervp metrics $metric --of out/rtl | tail -n 1
done
