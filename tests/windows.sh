#!/usr/bin/env bash
# The program for Windows under Wine says what the one for Linux says, byte for byte: tests/windows.sh [LINUX-PROGRAM [WINDOWS-PROGRAM]].
# Both have to be built; `cargo build --release -p deltav-cli --target x86_64-pc-windows-gnu` needs Debian's gcc-mingw-w64-x86-64.
set -euo pipefail
cd "$(dirname "$0")/.."
linux=$(realpath "${1:-target/debug/deltav}")
windows=$(realpath "${2:-${CARGO_TARGET_DIR:-target}/x86_64-pc-windows-gnu/release/deltav.exe}")
wine=$(command -v wine64 || command -v wine || { ls /usr/lib/wine/wine64 2>/dev/null; } || true)
[[ -n $wine ]] || { echo "Wine is not installed: Debian has it as wine64" >&2; exit 2; }
work=$(mktemp -d)
export WINEPREFIX=$work/wine WINEDEBUG=-all WINEDLLOVERRIDES="mscoree,mshtml=;bcryptprimitives=n,b" DELTAV_PROGRESS=off
trap 'WINEPREFIX=$work/wine wineserver -k 2>/dev/null || true; rm -rf "$work"' EXIT
timeout 300 "$wine" wineboot --init >/dev/null 2>&1 || true

# Rust's library takes random numbers for its hash maps from a library that Windows has and Wine has from version 8.9 on.
if ! "$wine" "$windows" --version >/dev/null 2>&1; then
    echo "This Wine has no bcryptprimitives.dll: one is made for it"
    cat >"$work/prng.c" <<'END'
#include <windows.h>
BOOLEAN NTAPI SystemFunction036(PVOID, ULONG);
__declspec(dllexport) BOOL WINAPI ProcessPrng(PBYTE to, SIZE_T length) { return SystemFunction036(to, (ULONG)length); }
END
    mkdir "$work/program"
    cp "$windows" "$work/program/deltav.exe"
    windows=$work/program/deltav.exe
    x86_64-w64-mingw32-gcc -shared -o "$work/program/bcryptprimitives.dll" "$work/prng.c" -ladvapi32
    "$wine" "$windows" --version >/dev/null
fi

compared=0 bytes=0 differ=0
# Runs both with the same arguments, and compares what they print, what they complain of and how they end. Line ends may differ.
same() {
    local one=0 two=0
    "$linux" "$@" >"$work/linux.out" 2>"$work/linux.err" </dev/null || one=$?
    "$wine" "$windows" "$@" >"$work/windows.out" 2>"$work/windows.err" </dev/null || two=$?
    sed -i 's/\r$//' "$work/windows.out" "$work/windows.err"
    compared=$((compared + 1))
    bytes=$((bytes + $(stat -c %s "$work/linux.out") + $(stat -c %s "$work/linux.err")))
    if ((one != two)) || ! cmp -s "$work/linux.out" "$work/windows.out" || ! cmp -s "$work/linux.err" "$work/windows.err"; then
        differ=$((differ + 1))
        echo "different: deltav $* (status $one and $two)"
        diff "$work/linux.out" "$work/windows.out" | head -6 || true
        diff "$work/linux.err" "$work/windows.err" | head -6 || true
    fi
}
# Two files, of which the second was written by Windows.
same_file() {
    compared=$((compared + 1))
    bytes=$((bytes + $(stat -c %s "$1")))
    if ! cmp -s "$1" <(sed 's/\r$//' "$2"); then
        differ=$((differ + 1))
        echo "different: the files $1 and $2"
    fi
}

mapfile -t cases < <(find fixtures -name '*.toml' -not -name published.toml | LC_ALL=C sort)
for case in "${cases[@]}"; do
    same check "$case"
    same reconstruct "$case" --format json
    same impact "$case" --format json
    same crush "$case" --format json
    same motion "$case" --format json
done
for case in fixtures/avoid/*.toml; do same avoid "$case"; done
same uncertainty fixtures/sae-980025-uncertain.toml --format json --seed 7 --samples 4096
same estimate fixtures/estimate.toml --format json
same recorder fixtures/recorder.toml
same reconstruct fixtures/sae-980025.toml fixtures/rear-end.toml --format csv
same --help
same explain pdof

# Names with spaces, umlauts and a sign outside of code page 850, from a template to a report that is handed over.
folder="$work/Fälle für Ω"
mkdir "$folder"
for of in linux windows; do mkdir "$folder/$of"; done
(cd "$folder/linux" && "$linux" new -o "Unfall Größe 1.toml" && "$linux" reconstruct "Unfall Größe 1.toml" --format html -o "Gut achten.html") || true
(cd "$folder/windows" && "$wine" "$windows" new -o "Unfall Größe 1.toml" && "$wine" "$windows" reconstruct "Unfall Größe 1.toml" --format html -o "Gut achten.html") || true
for name in "Unfall Größe 1.toml" "Gut achten.html"; do
    if [[ -e $folder/linux/$name && -e $folder/windows/$name ]]; then
        same_file "$folder/linux/$name" "$folder/windows/$name"
    else
        differ=$((differ + 1))
        echo "different: $name was not written by both"
    fi
done
echo "${#cases[@]} fixtures, $compared comparisons, $bytes bytes: $differ different"
((differ == 0))
