#!/bin/sh
# Makes the meshes of the caisson from their geometry. Needs gmsh (4.8.4 of Debian 12 gives the committed bytes) and awk.
#
#   make.sh                               the files of this folder
#   make.sh FOLDER SIZE ALGORITHM         base and stiffeners in FOLDER, all of edge length SIZE by Mesh.Algorithm
#   make.sh FOLDER SIZE ALGORITHM NAME    both in one conforming mesh NAME.unv, as from CAD
set -eu
cd "$(dirname "$0")"
folder=${1-.}
settings=${2+-setnumber size $2 -setnumber algorithm $3}
raw=$(mktemp -d)
trap 'rm -rf "$raw"' EXIT

make_part() {  # geometry, name, first label, labels in a run, labels skipped after it
  gmsh -2 -nt 1 -v 2 $settings -format unv -o "$raw/$2.unv" "$1.geo"
  awk -v first="$3" -v run="$4" -v gap="$5" -f relabel.awk "$raw/$2.unv" > "$folder/$2.unv"
}
if [ $# -eq 4 ]; then
  settings="$settings -setnumber assembled 1"
  make_part base "$4" 1 97 13
else
  make_part base base 1 97 13
  make_part stiffener_a stiffener_a 1001 40 3
  make_part stiffener_b stiffener_b 1 11 2
fi
