#!/bin/sh
# The two solver trees share nothing but common/. Checked from the sources (no include of the other tree) and
# from the libraries (no undefined symbol that only the other tree defines; every exported name has the prefix
# of its tree, so that no name can hide the other's). Each check is first shown a violation of its own making.
set -u
build=${CRITVEL_BUILD:-build}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0
checks=0

expect() { # expect DESCRIPTION COMMAND...
    description=$1
    shift
    checks=$((checks + 1))
    if ! "$@"; then
        echo "independence: $description"
        failures=$((failures + 1))
    fi
}

not() { ! "$@"; }

# Files of the folder that include anything of the folders named after it.
includes() { # includes FOLDER OTHER...
    folder=$1
    shift
    for other in "$@"; do
        grep -rnE "#[[:space:]]*include[[:space:]]*[<\"]([^>\"]*/)?$other/" "$folder" && return 0
    done
    return 1
}

# Without what AddressSanitizer adds for each global.
defined() { nm -g --defined-only "$1" | awk 'NF == 3 && $3 !~ /^__odr_asan/ { print $3 }' | sort -u; }
undefined() { nm -g --undefined-only "$1" | awk 'NF == 2 { print $2 }' | sort -u; }

# Names that the first library needs and the second defines.
calls() { # calls LIBRARY OTHER
    undefined "$1" >"$work/needed"
    defined "$2" >"$work/there"
    defined "$1" >"$work/own"
    comm -12 "$work/needed" "$work/there" | comm -23 - "$work/own" | grep .
}

foreign_names() { # foreign_names LIBRARY PREFIX
    defined "$1" | grep -vE "^$2"
}

# The checks can fail: a tree that includes, calls and names what it must not.
mkdir -p "$work/semianalytic"
printf '  #  include "../dgreen/operator.h"\nint dg_root(void);\nint plain(void) { return dg_root(); }\n' \
    >"$work/semianalytic/bad.c"
printf 'int dg_root(void);\nint dg_root(void) { return 1; }\n' >"$work/other.c"
(cd "$work" && sed 1d semianalytic/bad.c >bad.c && ${CC:-gcc} -c bad.c other.c) || exit 1
expect "an include is not seen" includes "$work/semianalytic" dgreen >/dev/null
expect "a call is not seen" calls "$work/bad.o" "$work/other.o" >/dev/null
expect "a name is not seen" foreign_names "$work/bad.o" sa_ >/dev/null

expect "semianalytic includes another tree" not includes semianalytic dgreen compare
expect "dgreen includes another tree" not includes dgreen semianalytic compare
expect "common includes a tree" not includes common semianalytic dgreen compare

sa=$build/libsemianalytic.a
dg=$build/libdgreen.a
common=$build/libcommon.a
expect "libsemianalytic.a defines nothing" test -n "$(defined "$sa")"
expect "libdgreen.a defines nothing" test -n "$(defined "$dg")"
expect "libsemianalytic.a calls libdgreen.a" not calls "$sa" "$dg"
expect "libdgreen.a calls libsemianalytic.a" not calls "$dg" "$sa"
expect "libcommon.a calls libsemianalytic.a" not calls "$common" "$sa"
expect "libcommon.a calls libdgreen.a" not calls "$common" "$dg"
expect "names of libsemianalytic.a without sa_" not foreign_names "$sa" sa_
expect "names of libdgreen.a without dg_" not foreign_names "$dg" dg_
expect "names of libcommon.a without cv_" not foreign_names "$common" cv_

passed=$((checks - failures))
echo "$((100 * passed / checks))%: Checks: $checks, Failures: $failures, Errors: 0"
test $failures = 0
