#!/bin/sh
# critvel-compare figures: the files are there, whole, the same to the byte every time; their numbers hold what the
# paper prints and what can be known without the program; wrong inputs.
set -u
build=${CRITVEL_BUILD:-build}
case $build in /*) ;; *) build=$(pwd)/$build ;; esac
compare=$build/critvel-compare
paper=$(pwd)/data/paper.ini
folder=$(mktemp -d) || exit 1
trap 'chmod -R u+w "$folder"; rm -rf "$folder"' EXIT
search=$PATH
failures=0
checks=0

# verify DESCRIPTION COMMAND...: the command must succeed
verify() {
    checks=$((checks + 1))
    description=$1
    shift
    "$@" >"$folder/verify" 2>&1 && return
    failures=$((failures + 1))
    echo "FAILED: $description"
    head -5 "$folder/verify"
}

# exits STATUS DESCRIPTION ARGUMENTS...: runs critvel-compare figures, output in $folder/out and $folder/err
exits() {
    wanted=$1
    description=$2
    shift 2
    PATH=$search "$compare" figures "$@" >"$folder/out" 2>"$folder/err"
    status=$?
    verify "$description: exit status $status, not $wanted: $(head -c 200 "$folder/err")" test "$status" -eq "$wanted"
}

# refuses STATUS PATTERN DESCRIPTION ARGUMENTS...: one line on standard error, none on standard output
refuses() {
    wanted=$1
    pattern=$2
    description=$3
    shift 3
    exits "$wanted" "$description" "$@"
    verify "$description: one line" test "$(wc -l <"$folder/err")" -eq 1
    verify "$description: says \"$pattern\"" grep -q -e "$pattern" "$folder/err"
    verify "$description: no answer" test ! -s "$folder/out"
}

is_svg() { head -5 "$1" | grep -q '<svg ' && tail -2 "$1" | grep -q '</svg>'; }
is_pdf() { head -c 5 "$1" | grep -q '%PDF-' && tail -c 7 "$1" | grep -q '%%EOF'; }

# the lines of block NAME in a data file
block() { awk -v name="# $2" '/^# alpha/ { next } /^#.*,/ { if (on) print; next } /^#/ { on = $0 == name; next } on' "$1"; }

# close A B RELATIVE
close() { awk -v a="$1" -v b="$2" -v r="$3" 'BEGIN { d = a - b; if (d < 0) d = -d; if (b < 0) b = -b; exit !(a != "" && d <= r * b) }'; }

# peaks COLUMN SIGN FILE: local maxima of SIGN * column along the curve, rounded as the paper prints them
peaks() {
    block "$3" curves | awk -v c="$1" -v s="$2" '
        NF < 4 { n = 0; next }
        { x = y; a = b; y = z; b = e; z = s * $c; e = $1; n++ }
        n >= 3 && y > x && y >= z { printf "%.3f\n", b }'
}

first=$folder/a/new/folder
exits 0 "figures 6 and 7" "$paper" -o "$first" --only 6,7
verify "nothing on standard error" test ! -s "$folder/err"
verify "every picture is listed" test "$(grep -c '^deflection-[1-4] ' "$folder/out")" -eq 4
for case in 1 2 3 4; do
    verify "deflection-$case.svg is SVG" is_svg "$first/deflection-$case.svg"
    verify "deflection-$case.pdf is PDF" is_pdf "$first/deflection-$case.pdf"
done
verify "four files for each picture, no other" test "$(ls -A "$first" | wc -l)" -eq 16
exits 0 "figures 6 and 7 again" "$paper" -o "$folder/again" --case 4 --only deflection --threads 1
# cairo from 1.18 on puts the date where it cannot be taken out: inside a compressed object stream
for file in "$folder"/again/*; do
    grep -q -a ObjStm "$file" || verify "the same bytes: $file" cmp "$file" "$first/${file##*/}"
done
verify "no date in the PDF" sh -c "! grep -q -a CreationDate '$first/deflection-3.pdf'"

exits 0 "one case, one format" "$paper" -o "$folder/one" --only 6 --case 3 --format pdf
verify "only that" test "$(ls "$folder/one" | tr '\n' ' ')" = "deflection-3.dat deflection-3.gp deflection-3.pdf "
(cd "$folder/one" && gnuplot deflection-3.gp)
verify "gnuplot alone draws the same SVG beside the script" cmp "$folder/one/deflection-3.svg" "$first/deflection-3.svg"

# Section 5: case 4 has local extremes of max at 0.304 and 0.329, of min at 0.329, at the active point at 0.293.
for wanted in "2 1 0.304" "2 1 0.329" "3 -1 0.329" "4 1 0.293"; do
    set -- $wanted
    verify "case 4, column $1: extreme at $3" sh -c "echo '$(peaks "$1" "$2" "$first/deflection-4.dat")' | grep -q '^$3'"
done
verify "case 3: extreme of max at 0.404" sh -c "echo '$(peaks 2 1 "$first/deflection-3.dat")' | grep -q '^0.404'"
verify "case 4: resonances 0.437, 0.456 true, 0.442 false" test "$(block "$first/deflection-4.dat" true |
    awk 'NF == 1 { printf "%.3f ", $1 }')$(block "$first/deflection-4.dat" false | awk 'NF == 1 { printf "%.3f", $1 }')" = \
    "0.437 0.456 0.442"
verify "case 1: four resonances in the file's range and one beyond" test "$(cat "$first/deflection-1.dat" |
    awk 'NF == 1 && $1 > 0' | wc -l)" -eq 5

# At rest, springs in series: w = (1 / kappa_p + 1 / kappa_b + 1)^(3/4). At alpha = 0.02 a little more.
while read -r case springs; do
    verify "case $case: static deflection" close "$(block "$first/deflection-$case.dat" curves | awk 'NF == 4 { print $4; exit }')" \
        "$(awk -v s="$springs" 'BEGIN { print s ^ 0.75 }')" 0.01
done <<'END'
1 1.14619
2 1.17619
3 34.66667
4 44.33333
END
# There, and without waves yet, the smallest deflection is that of a beam on springs: -exp(-pi) of the largest.
verify "case 1: uplift nearly at rest" close "$(block "$first/deflection-1.dat" curves | awk 'NF == 4 { print $3 / $2; exit }')" \
    -0.0432139 0.05
# Above the last true resonance of case 3 the wave has left the active point: "the sudden jump to zero deflection".
verify "case 3: nothing at the active point above 0.7501" sh -c "block() { :; }; awk 'NF == 4 && \$1 > 0.7501 { n++; if (\$4 > 1e-6 || \$4 < -1e-6) exit 1 } END { exit !(n > 100) }' '$first/deflection-3.dat'"

# Figures 2 and 3. z is eta_M zeta, and zeta the other method's.
# on_curve NAME CASE DAMPING ALPHA PANEL ETA_M: a vertex of the curve against critvel-semianalytic kernel
on_curve() {
    set -- "$@" $(block "$folder/curves/$1.dat" "$5 boundary" | awk 'NF == 3 && $1 > 0 { q[++n] = $0 } END { print q[int(n / 3)] }')
    "$build/critvel-semianalytic" kernel "$paper" --case "$2" --damping "$3" --alpha "$4" --frequency "$7" --digits 12 --format json |
        awk -v eta_M="$6" -v re="$8" -v im="$9" '
            /"zeta"/ { on = 1 } on && /"re"/ { gsub(/[",]/, ""); a = $2 } on && /"im"/ { gsub(/[",]/, ""); b = $2; exit }
            END { d = (eta_M * a - re) ^ 2 + (eta_M * b - im) ^ 2; exit !(d < 1e-14 * (re ^ 2 + im ^ 2) && d >= 0 && re != 0) }'
}
# stable NAME PANEL: z = 1 lies on a stable part of the real axis
stable() { block "$folder/curves/$1.dat" "$2 stable" | awk 'NF == 2 { if (n++ % 2) { if (from < 1 && $1 > 1) found = 1 } from = $1 } END { exit !found }'; }
exits 0 "figure 2" "$paper" -o "$folder/curves" --only 2 --case 1 --damping 0.05 --alpha 0.3 --format svg
exits 0 "figure 3" "$paper" -o "$folder/curves" --only curve-left --case 3 --format svg
verify "figure 3 of case 3 is at damping 1e-4 and alpha 0.45" grep -q 'to the left, case 3, damping 0.0001, alpha = 0.45$' "$folder/out"
for name in curve-right-1 curve-left-3; do
    verify "$name.svg is SVG" is_svg "$folder/curves/$name.svg"
    verify "$name: a) is stable" stable $name a
    verify "$name: b) is not" sh -c "! $(stable $name b && echo true || echo false)"
done
mass() { sed -n "s/^set title '$2).* = \([0-9.]*\): .*/\1/p" "$folder/curves/$1.gp"; }
verify "figure 2: a vertex" on_curve curve-right-1 1 0.05 0.3 a "$(mass curve-right-1 a)"
verify "figure 3: a vertex" on_curve curve-left-3 3 1e-4 0.45 b "$(mass curve-left-3 b)"
verify "figure 2: the heavier mass is unstable" test "$(mass curve-right-1 a)" -lt "$(mass curve-right-1 b)"
verify "figure 3: the lighter mass is unstable" test "$(mass curve-left-3 a)" -gt "$(mass curve-left-3 b)"
exits 0 "a case without" "$paper" -o "$folder/curves" --only 3 --case 1 --damping 0.1 --alpha 0.3
verify "it is said" grep -q '^curve-left-1 *not drawn, case 1: no crossing' "$folder/out"
exits 0 "--mass-ratio" "$paper" -o "$folder/curves" --only 2 --case 1 --alpha 0.3 --mass-ratio 80 --format svg
verify "one panel" test "$(grep -c '^plot' "$folder/curves/curve-right-1.gp")" -eq 1

# Figures 4 and 5. crossings FIXED WANTED VALUE: column WANTED where column FIXED passes VALUE along the lines, in the
# order of size, by interpolation in alpha and log eta_M
crossings() {
    awk -v fixed="$1" -v wanted="$2" -v value="$3" '
        function scale(column, x) { return column == 2 ? log(x) : x }
        BEGIN { v = scale(fixed, value) }
        NF != 3 || /^#/ { n = 0; next }
        { x = scale(fixed, $fixed); y = scale(wanted, $wanted) }
        n++ && (before - v) * (x - v) < 0 {
            z = last + (y - last) * (v - before) / (x - before)
            printf "%.5f\n", wanted == 2 ? exp(z) : z
        }
        { before = x; last = y }' | sort -n
}
exits 0 "figure 4 b)" "$paper" -o "$folder/lines" --only 4 --case 2 --damping 0.05 --format svg
verify "lines-2.svg is SVG" is_svg "$folder/lines/lines-2.svg"
"$build/critvel-dgreen" transitions "$paper" --case 2 --damping 0.05 --mass-ratio 300 --digits 10 |
    awk '$1 == "alpha" && $2 < 1 { print $2 }' >"$folder/transitions"
block "$folder/lines/lines-2.dat" "lines 1" | crossings 2 1 300 >"$folder/crossings"
verify "case 2: three of the other method's transitions" test "$(wc -l <"$folder/transitions")" -eq 3
verify "case 2: as many crossings of eta_M = 300" test "$(wc -l <"$folder/crossings")" -eq 3
paste "$folder/transitions" "$folder/crossings" >"$folder/pairs"
while read -r transition crossing; do
    verify "a line passes eta_M = 300 at the transition $transition" close "$crossing" "$transition" 0.002
done <"$folder/pairs"
exits 0 "figure 5 b)" "$paper" -o "$folder/lines" --only lines --case 4 --damping 1e-10 --format svg
verify "case 4, 1e-10: one crossing at alpha = 0.4, eta_M = 231" close \
    "$(block "$folder/lines/lines-4.dat" "lines 1" | crossings 1 2 0.4)" 231.0 0.01

# The map against the roots that the other method finds, at fields all over the plane.
# same_roots ALPHA ETA_M ROOTS GROWTH
same_roots() {
    "$build/critvel-semianalytic" roots "$paper" --case 1 --damping 0.05 --alpha "$1" --mass-ratio "$2" --digits 10 |
        awk -v wanted="$3" -v growth="$4" '
            NR == 1 { roots = $3 } /^unstable/ && $5 > greatest { greatest = $5 }
            END { d = greatest - growth; exit !(roots == wanted && d * d <= 1e-8 * growth * growth) }'
}
exits 0 "map" "$paper" -o "$folder/map" --only map --case 1 --damping 0.05 --format svg
verify "map-1.svg is SVG" is_svg "$folder/map/map-1.svg"
block "$folder/map/map-1.dat" "map 1" | awk 'NF == 4 && ++n % 1607 == 800' >"$folder/fields"
verify "stable and unstable fields among them" test "$(awk '{ print $3 }' "$folder/fields" | sort -u | wc -l)" -eq 2
verify "fields in the middle of the picture" close "$(block "$folder/map/map-1.dat" "map 1" |
    awk 'NF == 4 { b = $2; if (!n++) a = b } END { print a * b }')" 1000 1e-6
while read -r alpha eta_M roots growth; do
    verify "map at alpha $alpha, eta_M $eta_M" same_roots "$alpha" "$eta_M" "$roots" "$growth"
done <"$folder/fields"

# Steady shapes: springs in series nearly at rest; equal far ahead and far behind before waves are radiated.
exits 0 "steady shapes" "$paper" -o "$folder/steady" --only steady --case 2 --alpha 0.02 --format svg
verify "steady-2.svg is SVG" is_svg "$folder/steady/steady-2.svg"
verify "deflection at the force" close "$(block "$folder/steady/steady-2.dat" a | awk '$1 == 0 { print $2 }')" \
    "$(awk 'BEGIN { print 1.17619 ^ 0.75 }')" 0.01
verify "rail, sleepers, ballast: less and less" sh -c "echo '$(block "$folder/steady/steady-2.dat" a | awk '$1 == 0')' |
    awk '{ exit !(\$2 > \$3 && \$3 > \$4 && \$4 > 0) }'"
exits 1 "steady shapes at a resonance velocity" "$paper" -o "$folder/steady" --only steady --case 3 --alpha 0.44485524035145315
verify "it is said" grep -q '^steady-3 .*not drawn' "$folder/out"

# Names of cases become names of files, and text in the pictures; nothing in them is a command or markup.
cat >"$folder/names.awk" <<'END'
/^\[case 2\]/ { print "[case \"` touch " ran " `\"]"; next }
/^\[case 3\]/ { print "[case ../$(touch x) '_^{}\\]"; next }
/^\[case 4\]/ { print "[case ..-` touch x `__^{}\\]"; next }
{ print }
END
awk -v ran="$folder/r" -f "$folder/names.awk" "$paper" >"$folder/names.ini"
exits 0 "names that are not file names" "$folder/names.ini" -o "$folder/names dir's" --only 6 --format svg
verify "all four are there, also the two that would be the same" test "$(ls "$folder/names dir's"/*.svg | wc -l)" -eq 4
exits 0 "such a name in a title" "$folder/names.ini" -o "$folder/names" --only 3 --case "../\$(touch x) '_^{}\\" --format svg
verify "it is there as it is" grep -q "case ../\$(touch x) '_^{}\\\\, damping" "$folder"/names/*.svg
exits 0 "commands in a title" "$folder/names.ini" -o "$folder/names" --only 2 --format svg \
    --case "\"\` touch $folder/r \`\""
verify "nothing ran" test ! -e "$folder/r"

refuses 2 'missing option -o' "no folder" "$paper"
refuses 2 'needs a value' "-o without a value" "$paper" -o
refuses 2 'there is no figure "8"' "no such figure" "$paper" -o "$folder/no" --only 6,8
refuses 2 'alpha' "a negative velocity" "$paper" -o "$folder/no" --alpha -1
refuses 2 'mass-ratio' "no mass" "$paper" -o "$folder/no" --mass-ratio 0
refuses 2 'damping' "a negative damping" "$paper" -o "$folder/no" --damping -1
refuses 2 'neither svg nor pdf' "no such format" "$paper" -o "$folder/no" --format png
refuses 2 'No such file' "no case file" "$folder/missing.ini" -o "$folder/no"
refuses 2 'no case' "no such case" "$paper" -o "$folder/no" --case 9
verify "nothing was made for them" test ! -e "$folder/no"
: >"$folder/file"
refuses 3 'Not a directory' "a file in place of the folder" "$paper" -o "$folder/file" --only 6
refuses 3 'Not a directory' "a file as parent" "$paper" -o "$folder/file/sub" --only 6
if [ "$(id -u)" != 0 ]; then
    mkdir "$folder/closed" && chmod a-w "$folder/closed"
    refuses 3 'Permission denied' "a folder that is closed" "$paper" -o "$folder/closed" --only 6
fi
mkdir -p "$folder/taken/deflection-3.svg"
refuses 3 'deflection-3.svg' "a folder where the picture should be" "$paper" -o "$folder/taken" --only 6 --case 3
mkdir "$folder/bin"
search=$folder/bin
refuses 3 'Debian package gnuplot-nox' "no gnuplot" "$paper" -o "$folder/no" --only 6
verify "no folder without gnuplot" test ! -e "$folder/no"
printf '#!/bin/sh\necho "line 1: it is broken" >&2\nexit 1\n' >"$folder/bin/gnuplot"
chmod +x "$folder/bin/gnuplot"
search=$folder/bin:$PATH
refuses 3 'it is broken' "a gnuplot that fails" "$paper" -o "$folder/broken" --only 6 --case 3
verify "it leaves nothing" test -z "$(ls -A "$folder/broken")"
printf '#!/bin/sh\nexit 0\n' >"$folder/bin/gnuplot"
refuses 3 'gnuplot has not written' "a gnuplot that draws nothing" "$paper" -o "$folder/broken" --only 6 --case 3

echo "Checks: $checks, Failures: $failures"
[ "$failures" -eq 0 ]
