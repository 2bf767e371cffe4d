#!/bin/sh
# In a fresh Debian with the packages under /tmp/packages: what installing gives the deployer, that
# upgrading keeps what he changed, and that purging leaves nothing. cross/package.sh try runs it.
set -eu
export DEBIAN_FRONTEND=noninteractive LC_ALL=C
fail() {
  echo "install test: $*" >&2
  exit 1
}
files() { find / -xdev -name '*caryatid*' ! -path '/tmp/*' ! -path '/proc/*' ! -path '/sys/*'; }

[ -z "$(files)" ] || fail "this Debian is not fresh: $(files)"
apt-get install -qq -y --no-install-recommends libgl1-mesa-dri /tmp/packages/*.deb >/tmp/apt.log ||
  { tail /tmp/apt.log >&2; fail "apt refuses"; }

# The user has its devices' groups, and no screen is taken over unasked.
for group in gpio video render input audio; do
  id -nG caryatid | grep -qw "$group" || fail "caryatid is not in group $group"
done
[ "$(systemctl is-enabled caryatid.service)" = disabled ] || fail "the service starts unasked"
[ -f /lib/udev/rules.d/70-caryatid.rules ] || fail "no udev rules"
systemd-analyze verify --man=no caryatid.service || fail "systemd refuses the service"

# The installed program with the installed programme and character.
caryatid --config /etc/caryatid/kiosk.toml --pack /usr/share/caryatid/woman.pack --check
caryatid --list-hardware | grep -q '^GPIO' || fail "--list-hardware says nothing of GPIO"
caryatid --config /etc/caryatid/kiosk.toml --pack /usr/share/caryatid/woman.pack --display none \
  --virtual-clock --duration 2 --say "Welcome!" --audio file:/tmp/said.wav --metrics /tmp/frames
[ "$(wc -l </tmp/frames)" -eq 60 ] || fail "not 60 frames"
# More than silence: samples that are not zero behind the header.
[ "$(tail -c +45 /tmp/said.wav | tr -d '\0' | wc -c)" -gt 1000 ] || fail "nothing was said"
caryatid-tool render --pack /usr/share/caryatid/man.pack -o /tmp/man.png
[ -s /tmp/man.png ] || fail "caryatid-tool draws nothing"

# Changes under /etc/caryatid outlive an upgrade.
echo "# mine" >>/etc/caryatid/texts/en.toml
dpkg -i /tmp/packages/caryatid_*.deb >/tmp/dpkg.log 2>&1 || fail "no upgrade: $(cat /tmp/dpkg.log)"
tail -1 /etc/caryatid/texts/en.toml | grep -qx '# mine' || fail "an upgrade took a changed text"

systemctl enable caryatid.service 2>/dev/null
install -d -o caryatid /var/lib/caryatid /var/cache/caryatid
dpkg --remove caryatid >/dev/null 2>&1
[ -f /etc/caryatid/texts/en.toml ] || fail "removing took the programme"
dpkg --purge caryatid caryatid-data caryatid-voice caryatid-tools >/dev/null 2>&1
[ -z "$(files)" ] || fail "left behind: $(files)"
! getent passwd caryatid || fail "the user is left behind"
echo "install test: installed, tried, upgraded, purged"
