#!/bin/sh
# Makes the files of this folder from their geometry. Needs gmsh (4.8.4 of Debian 12 gives the committed bytes) and awk.
set -eu
cd "$(dirname "$0")"
raw=$(mktemp -d)
trap 'rm -rf "$raw"' EXIT

make_part() {  # name, first label, labels in a run, labels skipped after it
  gmsh -2 -nt 1 -v 2 -format unv -o "$raw/$1.unv" "$1.geo"
  awk -v first="$2" -v run="$3" -v gap="$4" -f relabel.awk "$raw/$1.unv" > "$1.unv"
}
make_part base 1 97 13
make_part stiffener_a 1001 40 3
make_part stiffener_b 1 11 2
