#!/usr/bin/env bash
# Debian packages for boards: caryatid, caryatid-data, caryatid-voice, caryatid-tools.
set -euo pipefail
cd "$(dirname "$0")/.."

usage() {
  cat <<'TEXT'
usage: cross/package.sh [arm64|armhf] [bookworm|trixie]   packages for a board
       cross/package.sh amd64                             packages for a PC like this one
       cross/package.sh try [bookworm|trixie]             installs, tries, upgrades and purges those
                                                          of the PC in a fresh Debian

Default: arm64 bookworm. Cross-compiles (cross/board.sh), bakes the characters (cross/host.sh) and
checks what came out with lintian. The packages lie in build/packages/RELEASE/:
  caryatid_VERSION_ARCH.deb        the agent and its service
  caryatid-data_VERSION_all.deb    the characters
  caryatid-voice_VERSION_ARCH.deb  speech by espeak-ng (GPL-3+)
  caryatid-tools_VERSION_ARCH.deb  caryatid-tool
The same commit makes the same bytes.

example: cross/package.sh armhf && scp build/packages/bookworm/*.deb kiosk.local:
TEXT
}

say() { printf '%s\n' "caryatid: $*"; }
fail() {
  printf '%s\n' "caryatid: $*" >&2
  exit 1
}

# The package of a library, by its name in the program. A new library is a failure here, not at the
# deployer's.
package_of() {
  case "$1" in
    libc.so.6 | libm.so.6 | ld-linux-*) ;;  # By version, below.
    libstdc++.so.6) echo "libstdc++6 (>= 12)" ;;
    libgcc_s.so.1) echo "libgcc-s1 (>= 3.0)" ;;
    libEGL.so.1) echo libegl1 ;;
    libGLESv2.so.2) echo libgles2 ;;
    libX11.so.6) echo libx11-6 ;;
    libwayland-client.so.0) echo "libwayland-client0 (>= 1.20.0)" ;;
    libwayland-egl.so.1) echo libwayland-egl1 ;;
    libgpiod.so.2) echo "libgpiod2 (>= 1.5.2)" ;;
    libgpiod.so.3) echo "libgpiod3 (>= 2.1)" ;;
    libhidapi-hidraw.so.0) echo libhidapi-hidraw0 ;;
    libgbm.so.1) echo "libgbm1 (>= 17.1.0)" ;;
    libdrm.so.2) echo "libdrm2 (>= 2.4.100)" ;;
    libasound.so.2) [ "$release" = bookworm ] && echo "libasound2 (>= 1.1)" || echo libasound2t64 ;;
    libespeak-ng.so.1) echo "libespeak-ng1 (>= 1.49.2)" ;;
    libpng16.so.16) [ "$release" = bookworm ] && echo libpng16-16 || echo libpng16-16t64 ;;
    libfreetype.so.6) echo libfreetype6 ;;
    libz.so.1) echo zlib1g ;;
    libFLAC.so.12) echo libflac12 ;;
    libFLAC.so.14) echo libflac14 ;;
    libharfbuzz-subset.so.0) echo libharfbuzz-subset0 ;;
    libharfbuzz.so.0) echo libharfbuzz0b ;;
    libfribidi.so.0) echo libfribidi0 ;;
    libunibreak.so.1) echo libunibreak1 ;;
    libunibreak.so.5) echo libunibreak5 ;;
    libunibreak.so.6) echo libunibreak6 ;;
    *) fail "no Debian package is known for $1; add it to cross/package.sh" ;;
  esac
}

# depends_of PROGRAM: what stands behind Depends:.
depends_of() {
  local name glibc list
  glibc=$(readelf -V "$1" | grep -oE 'GLIBC_2\.[0-9]+' | sort -Vu | tail -1)
  list="libc6 (>= ${glibc#GLIBC_})"
  for name in $(readelf -d "$1" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p'); do
    name=$(package_of "$name") || exit 1
    [ -z "$name" ] || list="$list, $name"
  done
  echo "$list"
}

# manual NAME SUMMARY PROGRAM: its --help as a manual page.
manual() {
  {
    printf '.TH %s 1 "" "Caryatid" "User Commands"\n.SH NAME\n%s \\- %s\n' "${1^^}" "$1" "$2"
    printf '.SH DESCRIPTION\n.nf\n'
    "$3" --help | sed -e 's/\\/\\\\/g' -e 's/-/\\-/g' -e "s/^\([.']\)/\\\\\&\1/"
    printf '.fi\n'
  } | gzip -9n >"$manuals/$1.1.gz"
}

make_manuals() {
  local version when
  manuals=$PWD/build/packages/manuals
  mkdir -p "$manuals"
  manual caryatid "information-kiosk agent" build/host-release/bin/caryatid
  manual caryatid-voice "voice of the kiosk agent" build/host-release/bin/caryatid-voice
  manual caryatid-tool "content tools of the kiosk agent" build/host-release/bin/caryatid-tool
  version=$(sed -n 's/^project(caryatid VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
  when=$(git log -1 --format=%ct 2>/dev/null || echo 0)
  gzip -9n >"$manuals/changelog.gz" <<TEXT
caryatid ($version) stable; urgency=medium

  * Built from $(git rev-parse --short=12 HEAD 2>/dev/null || echo "an unpacked tree").

 -- Caryatid <caryatid@example.org>  $(date -R -d "@$when")
TEXT
}

check_packages() {
  command -v lintian >/dev/null || fail "lintian is missing; apt-get install lintian"
  lintian --allow-root --fail-on error,warning --tag-display-limit 0 "$@" ||
    fail "lintian refuses the packages"
}

build() {
  if [ "$arch" != amd64 ]; then
    ./cross/board.sh build "$arch" "$release" -DCARYATID_HOST_TOOLS=ON
    return
  fi
  cmake --preset host-release -B "$folder" >"$folder.log" 2>&1 ||
    fail "configuring failed; $folder.log says why"
  # shellcheck disable=SC2086  # Several targets.
  nice ninja -C "$folder" --quiet $TARGETS || fail "building failed"
}

main() {
  local folder=build/cross-$arch-$release out=build/packages/$release
  export TARGETS="caryatid caryatid-voice caryatid-tool"
  ./cross/host.sh build
  build
  make_manuals
  SOURCE_DATE_EPOCH=$(git log -1 --format=%ct 2>/dev/null || echo 0)
  export SOURCE_DATE_EPOCH
  # Names of their own: a failure inside an argument would go unseen.
  local agent voice tools
  agent=$(depends_of "$folder/bin/caryatid")
  voice=$(depends_of "$folder/bin/caryatid-voice")
  tools=$(depends_of "$folder/bin/caryatid-tool")
  cmake -B "$folder" -DCARYATID_PACKS="$PWD/build/host-release/packs" \
    -DCARYATID_MANUALS="$manuals" -DCARYATID_DEBIAN_ARCHITECTURE="$arch" \
    -DCARYATID_DEPENDS="$agent" -DCARYATID_VOICE_DEPENDS="$voice" \
    -DCARYATID_TOOL_DEPENDS="$tools" >"$folder.log" 2>&1 ||
    fail "configuring failed; $folder.log says why"
  mkdir -p "$out"
  rm -f "$out"/*_"$arch".deb
  cpack --config "$folder/CPackConfig.cmake" -B "$out" >"$folder.cpack.log" 2>&1 ||
    { tail -n 20 "$folder.cpack.log" >&2; fail "packing failed"; }
  rm -rf "$out/_CPack_Packages"
  check_packages "$out"/caryatid{,-voice,-tools}_*_"$arch".deb "$out"/caryatid-data_*_all.deb
  ls -l "$out"/*.deb | awk '{printf "caryatid: %8.1f KiB  %s\n", $5 / 1024, $9}'
}

try_packages() {
  local packages scratch mode=()
  packages=(build/packages/"$release"/*_amd64.deb build/packages/"$release"/*_all.deb)
  [ -f "${packages[0]}" ] || fail "no packages; first run cross/package.sh amd64"
  [ "$(id -u)" -eq 0 ] && mode=(--mode=root)
  scratch=build/packages/try
  rm -rf "$scratch"
  mkdir -p "$scratch/packages"
  cp "${packages[@]}" "$scratch/packages"
  cp tests/board/install.sh "$scratch"
  # shellcheck disable=SC2016  # $1 is mmdebstrap's.
  mmdebstrap --quiet --variant=minbase "${mode[@]}" --include=systemd,udev \
    --customize-hook="copy-in $scratch/packages $scratch/install.sh /tmp" \
    --customize-hook='chroot "$1" /tmp/install.sh' "$release" /dev/null \
    http://deb.debian.org/debian
}

arch=${1:-arm64}
release=${2:-bookworm}
case "$arch $release" in
  "try bookworm" | "try trixie") try_packages ;;
  "amd64 bookworm" | "arm64 bookworm" | "arm64 trixie" | "armhf bookworm" | "armhf trixie") main ;;
  *)
    usage
    case "$arch" in -h | --help | help) exit 0 ;; esac
    exit 2
    ;;
esac
