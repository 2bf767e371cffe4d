#!/usr/bin/env bash
# Caryatid for boards: cross-compiled on a Debian 12 PC, its tests run by user-mode emulation.
set -euo pipefail
export PYTHONDONTWRITEBYTECODE=1
cd "$(dirname "$0")/.."

usage() {
  cat <<'TEXT'
usage: cross/board.sh build [arm64|armhf] [bookworm|trixie] [CMAKE-ARGS]   cross-compile the agent
       cross/board.sh unit  [arm64|armhf] [bookworm|trixie]   and run the board code's tests
       cross/board.sh image           a disk image for Raspberry Pi Zero 2 W, 3 and 4 and for UEFI
                                      boards: build/image/kiosk.img; see cross/image/README.md
       cross/board.sh image try       the same, then booted on an emulated board
       cross/board.sh test  [STEPS]   the kiosk on an emulated board, from power-on; see
                                      tests/board/emulated.py --help for the steps

Default: arm64 bookworm. The libraries come from packages of the board's own release, kept under
~/.cache/caryatid; bookworm has libgpiod 1.6, trixie libgpiod 2.
The program is build/cross-ARCH-RELEASE/bin/caryatid. TARGETS="NAME..." builds only these. Debian
packages: cross/package.sh --help.
test needs what cross/host.sh build leaves (the pack, and this PC's caryatid to compare with) and
leaves pictures in build/board. It takes about a quarter of an hour on two idle cores. Its seconds
are the board's own, counted in instructions, so a busy machine only takes longer.

example: cross/board.sh unit armhf
TEXT
}

# For the machine that compiles.
packages=(cmake ninja-build pkg-config python3 mmdebstrap qemu-user-static ca-certificates
  libwayland-bin)
# For the board: what caryatid and its tests link to.
libraries=(libc6-dev libgles-dev libegl-dev libgbm-dev libdrm-dev libx11-dev libwayland-dev
  wayland-protocols libgpiod-dev libhidapi-dev libasound2-dev libespeak-ng-dev libglm-dev
  libtomlplusplus-dev libstb-dev libgtest-dev libgmock-dev libbenchmark-dev nlohmann-json3-dev
  libeigen3-dev libcli11-dev libharfbuzz-dev libfribidi-dev libunibreak-dev
  libflac-dev libfreetype-dev)
# For the emulated board: what its image holds beside the project's own package.
board_packages=(systemd systemd-sysv udev kmod busybox-static linux-image-arm64 libegl1 libgles2
  libgl1-mesa-dri libegl-mesa0 libgbm1 libdrm2 libgpiod2 libhidapi-hidraw0 libx11-6
  libwayland-client0 libwayland-egl1 libasound2 libespeak-ng1 libstdc++6 libharfbuzz0b libfribidi0
  libunibreak1)
# For the image, beside what our packages depend on.
image_packages=(systemd systemd-sysv udev kmod mount util-linux busybox-static
  base-files libc-bin base-passwd linux-image-arm64 raspi-firmware systemd-boot-efi
  libgl1-mesa-dri tzdata)
cache="${XDG_CACHE_HOME:-$HOME/.cache}/caryatid"

say() { printf '%s\n' "caryatid: $*"; }
fail() {
  printf '%s\n' "caryatid: $*" >&2
  exit 1
}

install_packages() {
  local missing=() name root=()
  for name in "${packages[@]}"; do
    dpkg-query -W -f '${db:Status-Status}' "$name" 2>/dev/null | grep -qx installed ||
      missing+=("$name")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null ||
      fail "as root run: apt-get install --no-install-recommends ${missing[*]}"
    root=(sudo)
  fi
  say "installing ${missing[*]}"
  "${root[@]}" apt-get update -qq
  "${root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -qq -y --no-install-recommends "${missing[@]}" >/dev/null
}

# The board's libraries, unpacked and never run. Its name holds a hash of what it was made from.
make_sysroot() {
  local names scratch key mode=()
  names="${libraries[*]} $stdcxx"
  key=$(printf '%s' "$names" | sha256sum | cut -c1-12)
  sysroot="$cache/sysroot-$release-$arch-$key"
  [ -d "$sysroot" ] && return 0
  mkdir -p "$cache"
  scratch=$(mktemp -d "$cache/sysroot.XXXXXX")
  [ "$(id -u)" -eq 0 ] && mode=(--mode=root)
  say "unpacking the libraries of Debian $release for $arch"
  mmdebstrap --quiet --variant=extract "${mode[@]}" --skip=check/qemu --architectures="$arch" \
    --include="${names// /,}" "$release" "$scratch" http://deb.debian.org/debian \
    >"$cache/sysroot.log" 2>&1 ||
    fail "no sysroot of $release for $arch; $cache/sysroot.log says why"
  # As base-files of trixie has it, which is not among these.
  [ -e "$scratch/lib" ] || ln -s usr/lib "$scratch/lib"
  # Absolute links would lead to this PC's libraries.
  find "$scratch" -type l -lname '/*' -printf '%p\t%l\n' | while IFS=$'\t' read -r name target; do
    ln -srfT "$scratch$target" "$name"
  done
  mv -T "$scratch" "$sysroot"
}

build() {
  install_packages
  make_sysroot
  say "building for $arch, Debian $release"
  local fresh=()  # Libraries that were found in another sysroot must not stay.
  grep -qxF "CARYATID_SYSROOT:UNINITIALIZED=$sysroot" "$folder/CMakeCache.txt" 2>/dev/null ||
    fresh=(--fresh)
  cmake --preset "$preset" "${fresh[@]}" -B "$folder" -DCARYATID_SYSROOT="$sysroot" "${@:4}" \
    >"$folder.log" 2>&1 ||
    { tail -n 40 "$folder.log" >&2; fail "configuring failed"; }
  # shellcheck disable=SC2086  # Several targets, or none for all.
  nice ninja -C "$folder" --quiet ${TARGETS:-} || fail "building failed"
  say "built $folder/bin/caryatid"
}

# A replay must have the same bits on the board as here.
compare_hashes() {
  local here=build/cross-pc
  cmake --preset host-release -B "$here" -DCARYATID_HOST_TOOLS=OFF >"$here.log" 2>&1 ||
    { tail -n 40 "$here.log" >&2; fail "configuring failed"; }
  ninja -C "$here" --quiet caryatid-hashes || fail "building failed"
  "$here/bin/caryatid-hashes" >"$here/hashes.txt"
  "$emulator" -L "$sysroot" "$folder/bin/caryatid-hashes" >"$folder/hashes.txt"
  diff "$here/hashes.txt" "$folder/hashes.txt" || fail "$arch and this PC compute different bits"
  say "$arch computes the same face, body and pose as this PC: $(tr '\n' ' ' <"$folder/hashes.txt")"
}

# ARMv7 boards may lack NEON: the program must run there, too, and compute the same bits. Here on a
# Cortex-A9 without; the tests behind this run on a CPU that has it.
check_without_neon() {
  local cpu=cortex-a9,neon=off program
  "$emulator" -cpu "$cpu" -L "$sysroot" "$folder/bin/caryatid-hashes" |
    diff "$folder/hashes.txt" - || fail "without NEON armhf computes different bits"
  for program in golden_hashes unit_core_face; do
    "$emulator" -cpu "$cpu" -L "$sysroot" "$folder/bin/$program" >"$folder/$program.log" 2>&1 ||
      { tail -n 20 "$folder/$program.log" >&2; fail "$program fails without NEON"; }
  done
  grep -q 'NeonHasTheSameBits' <(grep SKIPPED "$folder/unit_core_face.log") ||
    fail "the CPU without NEON has it all the same"
  say "armhf computes the same without NEON"
}

# The emulated board's system, unpacked and prepared once; its name holds a hash of both recipes.
make_board_tree() {
  local names scratch key mode=()
  names="${board_packages[*]}"
  key=$({ printf '%s' "$names"; cat cross/board/tree.py; } | sha256sum | cut -c1-12)
  tree="$cache/board-$key"
  [ -d "$tree" ] && return 0
  mkdir -p "$cache"
  scratch=$(mktemp -d "$cache/unpack.XXXXXX")
  chmod 755 "$scratch"
  [ "$(id -u)" -eq 0 ] && mode=(--mode=root)
  say "unpacking the emulated board's Debian"
  mmdebstrap --quiet --variant=extract "${mode[@]}" --skip=check/qemu --architectures=arm64 \
    --include="${names// /,}" bookworm "$scratch" http://deb.debian.org/debian \
    >"$cache/board.log" 2>&1 ||
    { rm -rf "$scratch"; fail "no tree of the board; $cache/board.log says why"; }
  python3 cross/board/tree.py prepare "$scratch" || fail "the board's tree can't be prepared"
  mv -T "$scratch" "$tree"
}

# The packages of the agent and its voice, made of what was just built and unpacked where the board
# has them; cross/package.sh makes the same ones with manual pages and checks them.
fill_payload() {
  local out=build/board/packages deb
  rm -rf "$payload" "$out"
  mkdir -p "$payload/usr/share/caryatid" "$out"
  cmake -B "$folder" -DCARYATID_DEBIAN_ARCHITECTURE="$arch" >"$folder.log" 2>&1 &&
    cpack --config "$folder/CPackConfig.cmake" -B "$PWD/$out" \
      -D CPACK_COMPONENTS_ALL="caryatid;caryatid-voice" >"$folder.cpack.log" 2>&1 ||
    { tail -n 20 "$folder.cpack.log" >&2; fail "packing failed"; }
  for deb in "$out"/*.deb; do
    say "the board gets ${deb##*/}"
    dpkg-deb -x "$deb" "$payload"
  done
  cp "$pack" "$payload/usr/share/caryatid/woman.pack"
}

emulated_test() {
  local payload=build/board/payload pack=build/host-release/packs/woman.pack
  local host=build/host-release/bin/caryatid
  [ -x "$host" ] && [ -f "$pack" ] ||
    fail "$host or $pack is missing; first run cross/host.sh build"
  TARGETS="caryatid caryatid-voice"
  packages+=(qemu-system-arm e2fsprogs kmod cpio)
  build
  make_board_tree
  fill_payload
  python3 tests/board/emulated.py --tree "$tree" --payload "$payload" --pack "$pack" \
    --host "$host" --out build/board ${1:+--steps "$1"}
}

# The image's Debian, unpacked and prepared once for a set of packages and a recipe.
make_image_tree() {
  local names scratch key deb mode=()
  names=$(for deb in "$@"; do dpkg-deb -f "$deb" Depends; done | sed -e 's/([^)]*)//g' |
    tr -s ', ' '\n\n' | sort -u)
  names="${image_packages[*]} ${names//$'\n'/ }"
  key=$({ printf '%s' "$names"; cat cross/image/make.py cross/image/init; } | sha256sum |
    cut -c1-12)
  tree="$cache/image-$key"
  [ -d "$tree" ] && return 0
  mkdir -p "$cache"
  scratch=$(mktemp -d "$cache/unpack.XXXXXX")
  chmod 755 "$scratch"
  [ "$(id -u)" -eq 0 ] && mode=(--mode=root)
  say "unpacking the image's Debian"
  # shellcheck disable=SC2086  # One name a word.
  mmdebstrap --quiet --variant=extract "${mode[@]}" --skip=check/qemu --architectures=arm64 \
    --components=main,non-free-firmware --hook-dir=/usr/share/mmdebstrap/hooks/merged-usr \
    --include="$(echo $names | tr ' ' ',')" bookworm "$scratch" \
    http://deb.debian.org/debian >"$cache/image.log" 2>&1 ||
    { rm -rf "$scratch"; fail "no tree for the image; $cache/image.log says why"; }
  python3 cross/image/make.py prepare "$scratch" || fail "the image's tree can't be prepared"
  mv -T "$scratch" "$tree"
}

make_image() {
  local debs=() payload=build/image/payload deb name
  for name in caryatid caryatid-data caryatid-voice; do
    deb=$(ls -t build/packages/bookworm/"$name"_*_{arm64,all}.deb 2>/dev/null | head -1 || true)
    [ -n "$deb" ] || fail "$name is not packed; first run cross/package.sh arm64"
    debs+=("$deb")
  done
  packages+=(squashfs-tools dosfstools mtools fdisk e2fsprogs cpio kmod zstd fakeroot)
  [ "$try" != try ] || packages+=(qemu-system-arm)
  install_packages
  make_image_tree "${debs[@]}"
  rm -rf "$payload"
  mkdir -p "$payload"
  for deb in "${debs[@]}"; do dpkg-deb -x "$deb" "$payload"; done
  # What the deployer's folder is made from belongs to root whoever builds it.
  SOURCE_DATE_EPOCH=$(git log -1 --format=%ct 2>/dev/null || echo 1700000000) \
    fakeroot python3 cross/image/make.py image "$tree" "$payload" build/image
  say "build/image/kiosk.img; onto a card: dd if=build/image/kiosk.img of=/dev/sdX bs=4M"
  [ "$try" != try ] || python3 tests/board/image.py --out build/image
}

if [ "${1:-}" = test ]; then
  steps=${2:-}
  set -- test
fi
try=
if [ "${1:-}" = image ]; then
  try=${2:-}
  set -- image
fi
arch=${2:-arm64}
release=${3:-bookworm}
case "$arch" in
  arm64)
    preset=cross-aarch64
    emulator=qemu-aarch64-static
    packages+=(g++-aarch64-linux-gnu)
    ;;
  armhf)
    preset=cross-armhf
    emulator=qemu-arm-static
    packages+=(g++-arm-linux-gnueabihf)
    ;;
  *)
    usage >&2
    exit 2
    ;;
esac
case "$release" in
  # The compiler is Debian 12's for both, so are its C++ headers; a newer runtime is compatible.
  bookworm) stdcxx=libstdc++-12-dev ;;
  trixie) stdcxx=libstdc++-12-dev ;;
  *)
    usage >&2
    exit 2
    ;;
esac
folder="build/cross-$arch-$release"
mkdir -p build

case "${1:-}" in
  build) build "$@" ;;
  unit)
    build
    compare_hashes
    [ "$arch" != armhf ] || check_without_neon
    ctest --test-dir "$folder" --output-on-failure -j "$(nproc)"
    ;;
  image) make_image ;;
  test) emulated_test "$steps" ;;
  -h | --help | help) usage ;;
  *)
    usage >&2
    exit 2
    ;;
esac
