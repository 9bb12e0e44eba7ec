# Makes a universal file written by Gmsh look like one that has been worked on for years:
#   - labels start at `first` and skip `gap` numbers after every `run`, so that files overlap and have holes;
#   - units (dataset 164: mm, N) come first;
#   - groups of faces list no nodes, and points, which Gmsh lists but does not write, are left out.
# Usage: awk -v first=1 -v run=97 -v gap=13 -f relabel.awk in.unv > out.unv

function label(old) { return first + old - 1 + gap * int((old - 1) / run) }

# Entries of a group are kept back until all are known: a group of faces drops its nodes.
function flush_group(   i, n, faces) {
  if (name == "") return
  for (i = 1; i <= n_entries; i++) if (code[i] == 8 && (entry[i] in kind) && kind[entry[i]] == 91) faces = 1
  n = 0
  for (i = 1; i <= n_entries; i++) {
    if (code[i] == 8 && !(entry[i] in kind)) continue
    if (code[i] == 7 && faces) continue
    n++
    code[n] = code[i]; entry[n] = entry[i]
  }
  printf "%10d%10d%10d%10d%10d%10d%10d%10d\n%s\n", number, 0, 0, 0, 0, 0, 0, n, name
  for (i = 1; i <= n; i++) {
    printf "%10d%10d%10d%10d", code[i], label(entry[i]), 0, 0
    if (i % 2 == 0 || i == n) printf "\n"
  }
  name = ""
  n_entries = 0
}

BEGIN {
  print "    -1\n   164"
  printf "%10d%-20s%10d\n", 10, "  mm (N)", 2
  printf "%25s%25s%25s\n%25s\n    -1\n", "1.0000000000000000D+03", "1.0000000000000000D+00",
         "1.0000000000000000D+00", "2.7314999999999998D+02"
}

NF == 1 && $1 == "-1" { flush_group(); inside = !inside; if (inside) dataset = ""; print; next }
inside && dataset == "" { dataset = $1; line = 0; print; next }
{ line++ }

dataset == 2411 {
  if (line % 2 == 1) printf "%10d%10d%10d%10d\n", label($1), $2, $3, $4
  else print
  next
}

dataset == 2412 {
  if (NF == 6) {  # head of a record
    kind[$1] = $2
    to_skip = $2 == 21 ? 1 : 0  # lines of the record before its nodes
    printf "%10d%10d%10d%10d%10d%10d\n", label($1), $2, $3, $4, $5, $6
  } else if (to_skip > 0) {
    to_skip--
    print
  } else {
    for (i = 1; i <= NF; i++) printf "%10d", label($i)
    printf "\n"
  }
  next
}

dataset == 2477 {
  if (NF == 1) { name = $1; next }
  if (NF == 8 && $2 == 0) { flush_group(); number = $1; next }
  for (i = 1; i + 3 <= NF; i += 4) { n_entries++; code[n_entries] = $i; entry[n_entries] = $(i + 1) }
  next
}

{ print }
