#!/bin/sh
# Wrong inputs, given to all three programs: a message of one line, with file and line where there is one, nothing on
# standard output, exit status 2 (the user can mend it) or 3 (the system refused).
set -u
build=${CRITVEL_BUILD:-build}
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
failures=0
checks=0

compare() { "$build/critvel-compare" "$@"; }
dgreen() { "$build/critvel-dgreen" z "$@" --alpha 0.3 --frequency 0.22; }
semianalytic() { "$build/critvel-semianalytic" kernel "$@" --alpha 0.3 --frequency 0.22; }
programs="compare dgreen semianalytic"

complain() {
    failures=$((failures + 1))
    echo "FAILED: $*"
    sed 's/^/    stderr: /' "$folder/err" | cut -c 1-300 | head -5
}

# expect STATUS PATTERN DESCRIPTION: judges $status and $folder/out, $folder/err
expect() {
    checks=$((checks + 1))
    if [ "$status" -ne "$1" ]; then
        complain "$3: exit status $status, not $1"
    elif [ "$(wc -l <"$folder/err")" -ne 1 ]; then
        complain "$3: the message is not one line"
    elif [ "$(wc -c <"$folder/err")" -gt 700 ]; then
        complain "$3: the message is longer than 700 bytes"
    elif ! grep -q -e "$2" "$folder/err"; then
        complain "$3: the message lacks \"$2\""
    elif [ -s "$folder/out" ]; then
        complain "$3: something on standard output"
    fi
}

# refuse PATTERN DESCRIPTION ARGUMENTS...: every program must exit with 2
refuse() {
    pattern=$1
    description=$2
    shift 2
    for program in $programs; do
        $program "$@" >"$folder/out" 2>"$folder/err"
        status=$?
        expect 2 "$pattern" "$program, $description"
    done
}

good_run='[run]
damping = 0.1
mass_ratio = 10
alpha = 0.1 0.2
digits = 15'
good_case='[case 1]
mu_s = 6
mu_b = 35
kappa_p = 300
kappa_b = 7
eta_s = 0
eta_N = 0'
file=$folder/case.ini

# refuse_file PATTERN DESCRIPTION: the same for the file as it stands
refuse_file() {
    refuse "$1" "$2" "$file"
}

# in_run / in_case LINE-TO-REPLACE REPLACEMENT PATTERN DESCRIPTION
in_run() {
    printf '%s\n%s\n' "$good_run" "$good_case" | sed "s/^$1 = .*/$2/" >"$file"
    refuse_file "$3" "$4"
}

refuse "missing.ini: " "missing file" "$folder/missing.ini"
refuse "is a directory" "directory" "$folder"
: >"$file"
refuse_file "case.ini: .*empty" "empty file"
head -c 4096 /dev/zero | tr '\0' '\377' >"$file"
refuse_file "case.ini:1: " "binary garbage"
printf '%s\n%s\n' "$good_run" "$good_case" | tr '\n' '\0' >"$file"
refuse_file "case.ini:1: " "NUL bytes"
printf '%s\n' "$good_run" >"$file"
refuse_file "case.ini: no \[case" "no case"
printf '%s\n%s\n%s\n' "$good_run" "$good_case" "$good_case" >"$file"
refuse_file "case.ini:13: duplicate name '1'" "duplicate case names"
printf '%s\n%s\nmu_s = 6\n' "$good_run" "$good_case" >"$file"
refuse_file "case.ini:13: duplicate key" "duplicate key"
printf '%s\n%s\nmu_x = 6\n' "$good_run" "$good_case" >"$file"
refuse_file "case.ini:13: unknown key 'mu_x'" "unknown key"
printf '%s\n%s\n[cases]\n' "$good_run" "$good_case" >"$file"
refuse_file "case.ini:13: " "unknown section"
printf '%s\n%s\n' "$good_run" "$good_case" | grep -v kappa_b >"$file"
refuse_file "case.ini:6: missing key 'kappa_b'" "missing key"
printf '%s\n%s\n' "$good_run" "$good_case" | grep -v mass_ratio >"$file"
refuse_file "case.ini:.* missing key 'mass_ratio'" "missing mass ratio"
{
    printf '%s\n%s\nmu_s = ' "$good_run" "$good_case"
    head -c 1000000 /dev/zero | tr '\0' '1'
    echo
} >"$file"
refuse_file "case.ini:13: " "a line of a megabyte"

for value in "6x" "6,5" nan inf -inf 1e400 1e-400 "" "6 7" "0x10" "1e" "--6" "6e1.5" "6;5"; do
    in_run mu_s "mu_s = $value" "case.ini:7: " "mu_s = $value"
done
in_run mu_s "mu_s = -6" "case.ini:7: " "negative mass"
in_run mu_s "mu_s = 0" "case.ini:7: " "no mass"
in_run kappa_p "kappa_p = -300" "case.ini:9: " "negative stiffness"
in_run eta_N "eta_N = 100" "case.ini:.*buckl" "a resting track that buckles"
in_run damping "damping = 0.1 -0.1" "case.ini:2: " "negative damping"
in_run mass_ratio "mass_ratio = 0" "case.ini:3: " "no moving mass"
in_run mass_ratio "mass_ratio = 1 -1" "case.ini:3: " "negative moving mass"
in_run alpha "alpha = 0.2 0.1" "case.ini:4: " "reversed range"
in_run alpha "alpha = 0.2 0.2" "case.ini:4: " "empty range"
in_run alpha "alpha = 0 0.2" "case.ini:4: " "range from zero"
in_run alpha "alpha = 0.2" "case.ini:4: " "half a range"
in_run digits "digits = 0" "case.ini:5: " "no digits"
in_run digits "digits = 100000" "case.ini:5: " "too many digits"
in_run digits "digits = 20.5" "case.ini:5: " "broken digits"

printf '%s\n%s\n' "$good_run" "$good_case" >"$file"
refuse "2" "unknown case" "$file" --case 2
refuse "unknown" "unknown option" "$file" --no-such-option
refuse "given twice" "option twice" "$file" --case 1 --case 1
refuse "format" "unknown format" "$file" --format xml
refuse "damping" "negative --damping" "$file" --damping -1
refuse "damping" "--damping nan" "$file" --damping nan
refuse "surplus" "two files" "$file" "$file"
lines() { "$build/critvel-dgreen" lines "$@"; }
programs=lines
refuse "missing.ini: " "missing file" "$folder/missing.ini"
refuse "range first:last" "one velocity" "$file" --alpha 0.3
refuse "range first:last" "a row of velocities" "$file" --alpha 0.1:0.3:5
refuse "greater than the first" "reversed range" "$file" --alpha 0.3:0.1
refuse "0 < first < last" "range from zero" "$file" --alpha 0:0.3
refuse "0 < first < last" "negative masses" "$file" --mass-ratio -1:10
refuse "mass-ratio" "half a range" "$file" --mass-ratio 1:
refuse "alpha" "a range that is no number" "$file" --alpha 0.1:x
refuse "damping" "no damping" "$file" --damping 0
refuse "2" "unknown case" "$file" --case 2
dgreen() { "$build/critvel-dgreen" "$@"; }
programs=dgreen
refuse "one number" "a range for count" count "$file" --alpha 0.1:0.2
refuse "one number" "a row for transitions" transitions "$file" --mass-ratio 1:10:3
refuse "first:last:count" "a range for map" map "$file" --alpha 0.1:0.2 --mass-ratio 1
programs=compare
refuse "no case file" "no file"
refuse "threads" "no threads" "$file" --threads 0
refuse "threads" "threads that are not a number" "$file" --threads 2x

# Ranges, and what only some commands take.
refuse_lines() {
    pattern=$1
    description=$2
    shift 2
    "$build/critvel-semianalytic" lines "$file" "$@" >"$folder/out" 2>"$folder/err"
    status=$?
    expect 2 "$pattern" "lines, $description"
}
refuse_lines "alpha.*range" "one velocity" --alpha 0.3
refuse_lines "mass-ratio.*range" "one mass" --mass-ratio 10
refuse_lines "alpha" "reversed range" --alpha 0.9:0.3
refuse_lines "alpha" "empty end of a range" --alpha 0.3:
refuse_lines "mass-ratio" "range from zero" --mass-ratio 0:10
refuse_lines "mass ratios" "masses beyond the search" --mass-ratio 1:1e11
refuse_lines "format" "unknown format" --format xml
refuse_lines "given twice" "range twice" --alpha 0.1:0.2 --alpha 0.1:0.3
programs=semianalytic
refuse "csv" "csv of one point" "$file" --format csv
refuse "output" "--output of one point" "$file" --output "$folder/point"
programs=compare

# What the system refuses is status 3.
fails() {
    description=$1
    shift
    "$@" 2>"$folder/err"
    status=$?
    : >"$folder/out"
    expect 3 "." "$description"
}
full() { $1 "$file" >/dev/full; }
# The reader is gone before anything is written: opening the pipe read-write first lets the writer start.
closed() {
    mkfifo "$folder/pipe" && exec 8<>"$folder/pipe" 9>"$folder/pipe" && exec 8>&-
    $1 "$file" >&9 8>&-
    code=$?
    exec 9>&-
    rm "$folder/pipe"
    return $code
}
dgreen() { "$build/critvel-dgreen" z "$@" --alpha 0.3 --frequency 0.22; }
for program in compare dgreen lines semianalytic; do
    fails "$program, full disk" full $program
    fails "$program, closed pipe" closed $program
done
fails "output in a folder that is not there" compare "$file" --output "$folder/none/report"
fails "output onto a directory" compare "$file" --output "$folder"
fails "lines into a folder that is not there" "$build/critvel-semianalytic" lines "$file" --output "$folder/none/l"
fails "output onto a full disk" compare "$file" --output /dev/full
fails "lines, output in a folder that is not there" lines "$file" --output "$folder/none/report"
fails "lines, output onto a directory" lines "$file" --output "$folder"
fails "lines, output onto a full disk" lines "$file" --output /dev/full
printf '%s\n' "old" >"$folder/report"
printf 'wrong\n' >"$folder/wrong.ini"
compare "$folder/wrong.ini" --output "$folder/report" >"$folder/out" 2>"$folder/err"
status=$?
expect 2 "wrong.ini:1: " "bad input with --output"
lines "$folder/wrong.ini" --output "$folder/report" >"$folder/out" 2>"$folder/err"
status=$?
expect 2 "wrong.ini:1: " "lines, bad input with --output"
[ "$(cat "$folder/report")" = old ] || complain "bad input changed the output file"
[ -z "$(find "$folder" -name 'report.*')" ] || complain "a temporary file was left behind"

# --help and --version need no file and go to standard output.
for program in critvel-compare critvel-dgreen critvel-semianalytic; do
    for option in --help --version; do
        checks=$((checks + 1))
        "$build/$program" $option >"$folder/out" 2>"$folder/err"
        status=$?
        [ $status -eq 0 ] && [ -s "$folder/out" ] && [ ! -s "$folder/err" ] || complain "$program $option"
    done
    "$build/$program" --help >/dev/full 2>"$folder/err"
    status=$?
    : >"$folder/out"
    expect 3 "." "$program --help onto a full disk"
done

echo "Checks: $checks, Failures: $failures"
[ "$failures" -eq 0 ]
