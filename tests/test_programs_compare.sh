#!/bin/sh
# critvel-compare as a whole, on small runs: the same bytes every time and for any number of threads, standard output
# against --output, selection, warnings. (Memory errors and leaks: make check-sanitize. Valgrind cannot tell: it computes
# long double with 64 bits, and the certificates of semianalytic/ then fail, as they should.)
set -u
build=${CRITVEL_BUILD:-build}
case $build in /*) ;; *) build=$(pwd)/$build ;; esac
compare=$build/critvel-compare
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
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

# exits STATUS DESCRIPTION ARGUMENTS...: runs critvel-compare, output in $folder/out and $folder/err
exits() {
    wanted=$1
    description=$2
    shift 2
    "$compare" "$@" >"$folder/out" 2>"$folder/err"
    status=$?
    verify "$description: exit status $status, not $wanted" test "$status" -eq "$wanted"
}

cat >"$folder/small.ini" <<'END'
[run]
damping = 0.1 1e-4
mass_ratio = 3 100
alpha = 0.02 2.0
digits = 15
[case 1]
mu_s = 6
mu_b = 35
kappa_p = 300
kappa_b = 7
eta_s = 0
eta_N = 0
[track T]
EI = 6.4e6
m = 60
k_p = 1e8
c_p = 1e4
m_s = 250
k_b = 1e8
c_b = 1e4
m_b = 1000
k_s = 0
k_f = 6e7
c_f = 1e4
N = 0
M = 900
P = 1e5
END
small=$folder/small.ini

exits 0 "text" "$small" --threads 1
cp "$folder/out" "$folder/first.text"
verify "nothing on standard error" test ! -s "$folder/err"
exits 0 "text into a file" "$small" --threads 2 --output "$folder/report"
verify "nothing on standard output beside --output" test ! -s "$folder/out"
verify "--output has the same bytes, with one thread or two" cmp "$folder/report" "$folder/first.text"
exits 0 "json" "$small" --format json --threads 7
cp "$folder/out" "$folder/first.json"
exits 0 "json again" "$small" --format=json
verify "the same bytes from run to run" cmp "$folder/out" "$folder/first.json"
verify "the table ends with the verdict" grep -q '^verdict: agree (8 combinations: 8 agree' "$folder/first.text"
verify "the track has km/h" grep -q 'km/h' "$folder/first.text"
verify "schema" grep -q '"schema": "critvel-compare/1"' "$folder/first.json"
verify "errors in the print stand beside case 1 of table 1" grep -q 'G_Delta' "$folder/first.text"

exits 0 "--case and --damping" "$small" --case T --damping 0.05 --transitions
verify "only the case asked for" test "$(grep -c '^case \|^track ' "$folder/out")" -eq 1
verify "only the damping asked for" sh -c "! grep -q '^  1e-4' '$folder/out'"
verify "every transition is listed" grep -q '0 -> 2' "$folder/out"
verify "no case of table 1, nothing about the print" sh -c "! grep -q 'G_Delta' '$folder/out'"

sed 's/mu_b = 35/mu_b = 100/' "$small" >"$folder/outside.ini"
exits 0 "outside the ranges (31)" "$folder/outside.ini" --case 1 --damping 0.1
verify "a warning of one line" test "$(wc -l <"$folder/err")" -eq 1
verify "that names the value" grep -q 'mu_b' "$folder/err"


# A range that ends at a transition: whether it is inside cannot be told.
end=$(sed -n 's/.*"stability_limit": "\([0-9.]*\)".*/\1/p' "$folder/first.json" | head -1)
sed "s/^alpha = .*/alpha = 0.02 $end/" "$small" >"$folder/end.ini"
exits 1 "a transition at the end of the range" "$folder/end.ini" --case 1 --damping 0.1
verify "the verdict is undecided" grep -q '^verdict: undecided' "$folder/out"
verify "the reason is given" grep -q '^  undecided, damping 0.1, eta_M' "$folder/out"

"$compare" efficiency "$small" --case 1 >"$folder/out" 2>"$folder/err"
verify "efficiency: exit status 0" test $? -eq 0
verify "efficiency: a row for each method at each damping" test "$(grep -c 'semianalytic\|dgreen' "$folder/out")" -eq 4
cp "$small" "$folder/efficiency"
(cd "$folder" && "$compare" ./efficiency --case 1 --damping 0.1 >"$folder/out" 2>"$folder/err")
verify "a file that is called like a command" grep -q '^verdict' "$folder/out"

exits 0 "roots" roots "$small" --alpha 0.3 --mass-ratio 100
cp "$folder/out" "$folder/roots.text"
verify "roots: an unstable one of both methods" grep -q '^  unstable  both' "$folder/out"
verify "roots: the verdict" grep -q '^verdict: agree' "$folder/out"
exits 0 "roots again" roots "$small" --mass-ratio 100 --alpha 0.3
verify "roots: the same bytes" cmp "$folder/out" "$folder/roots.text"
exits 0 "roots as json" roots "$small" --alpha 0.3 --mass-ratio 100 --format json --digits 10
verify "roots: schema" grep -q '"schema": "critvel-compare-roots/1"' "$folder/out"
exits 2 "roots without a velocity" roots "$small" --mass-ratio 100
verify "roots: nothing written" test ! -s "$folder/out"
exits 2 "roots at rest" roots "$small" --alpha 0 --mass-ratio 100
exits 2 "roots without damping" roots "$small" --alpha 0.3 --mass-ratio 100 --damping 0
verify "roots: one line says why" test "$(wc -l <"$folder/err")" -eq 1

exits 0 "lines" lines "$small" --case 1 --damping 0.1 --samples 400 --threads 1
cp "$folder/out" "$folder/lines.text"
verify "lines: the verdict" grep -q '^verdict: agree (1 levels, 2 branches; 400 points counted, 0 mismatches' "$folder/out"
exits 0 "lines on two threads" lines "$small" --case 1 --damping 0.1 --samples 400 --threads 2
verify "lines: the same bytes" cmp "$folder/out" "$folder/lines.text"
exits 0 "lines as json" lines "$small" --case 1 --damping 0.1 --samples 40 --seed 7 --format json --mass-ratio 10:300
verify "lines: schema" grep -q '"schema": "critvel-compare-lines/1"' "$folder/out"
verify "lines: the range asked for" grep -q '"max": "300"' "$folder/out"
verify "lines: the seed" grep -q '"seed": 7' "$folder/out"
for range in 300 300:10 0:10 1:x :; do
    exits 2 "lines with --mass-ratio $range" lines "$small" --mass-ratio "$range"
    verify "lines: nothing written" test ! -s "$folder/out"
done
exits 2 "lines without damping" lines "$small" --damping 0
exits 2 "lines with half a sample" lines "$small" --samples 0.5

echo "Checks: $checks, Failures: $failures"
[ "$failures" -eq 0 ]
