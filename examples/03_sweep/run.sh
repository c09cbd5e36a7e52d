#!/bin/sh
# Twelve design points, and the best of them.
set -e
markervp sweep clocks.yaml --output out
echo
markervp pareto out
