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
export WINEPREFIX=$work/wine WINEDEBUG=-all WINEDLLOVERRIDES="mscoree,mshtml=;bcryptprimitives=n,b" DELTAV_PROGRESS=off LC_ALL=C.UTF-8
# Wine's server outlives the programs, and writes into the folder as it ends.
server=$(command -v wineserver64 || command -v wineserver || ls /usr/lib/wine/wineserver64 2>/dev/null || echo true)
trap '"$server" -k || true; "$server" -w || true; rm -rf "$work"' EXIT
timeout 300 "$wine" wineboot --init >/dev/null 2>&1 || true

# Rust's library takes random numbers for its hash maps from a library that Windows has and Wine has from version 8.9 on.
mkdir "$work/program"
if ! "$wine" "$windows" --version >/dev/null 2>&1; then
    echo "This Wine has no bcryptprimitives.dll: one is made for it"
    cat >"$work/prng.c" <<'END'
#include <windows.h>
BOOLEAN NTAPI SystemFunction036(PVOID, ULONG);
__declspec(dllexport) BOOL WINAPI ProcessPrng(PBYTE to, SIZE_T length) { return SystemFunction036(to, (ULONG)length); }
END
    cp "$windows" "$work/program/deltav.exe"
    windows=$work/program/deltav.exe
    x86_64-w64-mingw32-gcc -shared -o "$work/program/bcryptprimitives.dll" "$work/prng.c" -ladvapi32
    "$wine" "$windows" --version >/dev/null
fi
within=$work/program/within.exe
x86_64-w64-mingw32-gcc -municode -O1 -Wall -Werror -o "$within" tests/within.c

compared=0 bytes=0 differ=0
# Runs both with the same arguments, and compares what they print, what they complain of and how they end. Lines end alike, too.
same() {
    local one=0 two=0
    "$linux" "$@" >"$work/linux.out" 2>"$work/linux.err" </dev/null || one=$?
    "$wine" "$windows" "$@" >"$work/windows.out" 2>"$work/windows.err" </dev/null || two=$?
    compared=$((compared + 1))
    bytes=$((bytes + $(stat -c %s "$work/linux.out") + $(stat -c %s "$work/linux.err")))
    if ((one != two)) || ! cmp -s "$work/linux.out" "$work/windows.out" || ! cmp -s "$work/linux.err" "$work/windows.err"; then
        differ=$((differ + 1))
        echo "different: deltav $* (status $one and $two)"
        # What Windows says comes first: of Wine itself it may be one line.
        diff "$work/windows.out" "$work/linux.out" | head -6 || true
        diff "$work/windows.err" "$work/linux.err" | head -6 || true
    fi
}
# Two files, of which the second was written by Windows.
same_file() {
    compared=$((compared + 1))
    bytes=$((bytes + $(stat -c %s "$1")))
    if ! cmp -s "$1" "$2"; then
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

# On a console with the code page of old programs, and with that of UTF-8, the screen shows what Linux shows. Wine has a console where there
# is a terminal, which `script` gives; it draws spaces by moves of the cursor.
on_screen() {
    NO_COLOR=1 script --quiet --return --command "stty cols 240 rows 500; $(printf ' %q' "$@")" /dev/null </dev/null |
        perl -pe 's/\e\[(\d+)C/" " x $1/ge; s/\e\[[0-9;?]*[A-Za-z]//g; s/\e\][^\a]*\a//g; s/\r//g; s/ +$//'
}
same_on_screen() {
    local page=$1 one=0 two=0
    shift
    on_screen "$linux" "$@" >"$work/linux.out" || one=$?
    on_screen "$wine" "$within" codepage "$page" "$windows" "$@" >"$work/windows.out" || two=$?
    compared=$((compared + 1))
    bytes=$((bytes + $(stat -c %s "$work/linux.out")))
    if ((one != two)) || ! cmp -s "$work/linux.out" "$work/windows.out"; then
        differ=$((differ + 1))
        echo "different on a console of code page $page: deltav $* (status $one and $two)"
        diff "$work/linux.out" "$work/windows.out" | head -6 || true
    fi
}
printf 'title = "Größe Ω"\n[vehicle1]\nmass = 1500\n' >"$folder/linux/Falsch für Ω.toml"
cd "$folder/linux"
for page in 850 65001; do
    same_on_screen "$page" explain pdof
    same_on_screen "$page" check "Unfall Größe 1.toml"
    same_on_screen "$page" reconstruct "Unfall Größe 1.toml"
    same_on_screen "$page" check "Falsch für Ω.toml"
done

# What another program has open and shares with nobody gets a sentence that names it, and stays as it was.
refused() {
    local file=$1 status=0
    shift
    "$wine" "$within" held "$file" "$windows" "$@" >"$work/windows.out" 2>"$work/windows.err" </dev/null || status=$?
    compared=$((compared + 1))
    if ((status == 0 || status > 94)) || ! grep -qF "$file" "$work/windows.err" || grep -q panicked "$work/windows.err" || [[ -s $work/windows.out ]]; then
        differ=$((differ + 1))
        echo "$file is held by another program: deltav $* ended with $status and said:"
        head -6 "$work/windows.err"
    fi
}
cd "$folder/windows"
refused "Unfall Größe 1.toml" check "Unfall Größe 1.toml"
refused "Gut achten.html" reconstruct "Unfall Größe 1.toml" --format html -o "Gut achten.html"
same_file "$folder/linux/Gut achten.html" "Gut achten.html"
echo "${#cases[@]} fixtures, $compared comparisons, $bytes bytes: $differ different"
((differ == 0))
