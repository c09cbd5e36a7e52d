#!/bin/sh
# The demo scene: an image with a marker goes through the whole chip.
set -e
markervp run demo --output out
