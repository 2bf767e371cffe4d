#!/usr/bin/env python3
"""Makes the kiosk's disk image from an unpacked Debian tree. No root, no loop device, no script of
a package is run; the same input should make the same bytes. See README.md beside this file.

make.py prepare TREE              once per tree: users, drivers, settings, boot files
make.py image TREE PAYLOAD OUT    TREE with the files of PAYLOAD (a folder like /), as OUT/kiosk.img
"""

import glob
import os
import re
import shutil
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
EPOCH = int(os.environ.get("SOURCE_DATE_EPOCH", "1700000000"))
MIB = 1 << 20

DISK_ID = 0xCA47A71D
DATA_UUID = "ca47a71d-0000-4000-8000-000000000007"
# Partition number, MBR type, first MiB, MiB. The Raspberry Pi's firmware boots from the four
# primary partitions only; 4 is the extended one that holds 5 to 7.
PARTITIONS = [
    ("start", 1, "c", 4, 12),
    ("boot A", 2, "c", 16, 96),
    ("boot B", 3, "c", 112, 96),
    ("extended", 4, "f", 208, 1032),
    ("root A", 5, "83", 209, 384),
    ("root B", 6, "83", 594, 384),
    ("data", 7, "83", 979, 256),
]
SIZE_MIB = 1240

# Drivers that stay: the devices of a kiosk on a Raspberry Pi or in an emulated board, whole folders
# of the kernel's tree. What they need comes along.
DRIVERS = """
drivers/(virtio|clk|gpio|pinctrl|regulator|reset|soc|firmware|mailbox|dma|phy|pwm|nvmem)/
drivers/(thermal|cpufreq|hwmon|leds|mmc|hid|char/hw_random|usb/host|usb/core|usb/dwc2|usb/dwc3)/
drivers/(usb/storage/usb-storage|usb/phy|usb/common|scsi/sd_mod|block/virtio_blk|block/loop)
drivers/(char/virtio_console|i2c/busses/i2c-bcm|i2c/i2c-dev|spi/spi-bcm|input/evdev|rtc/)
drivers/(pci/controller|watchdog/(bcm2835_wdt|i6300esb|softdog))
drivers/(gpu/drm/(vc4|v3d|virtio|panel|bridge)|video/backlight|media/cec/core|staging/vc04)
sound/(core|usb|soc/bcm|soc/codecs/(snd-soc-hdmi|snd-soc-pcm5102a|snd-soc-max98357a)|soc/generic)
fs/(ext4|fat|overlayfs|squashfs|nls)/ crypto/crc32c lib/crc
""".split()
# Before there is a root: what the disk of any of these boards hangs on.
EARLY = """
drivers/(virtio|clk|gpio|pinctrl|regulator|reset|soc|firmware|mailbox|dma|phy|nvmem|mmc)/
drivers/(usb/host|usb/core|usb/dwc2|usb/storage/usb-storage|scsi/sd_mod|block/virtio_blk)
drivers/(pci/controller|i2c/busses/i2c-bcm) fs/(ext4|overlayfs|squashfs)/ crypto/crc32c
""".split()

FILES = {
    "etc/hostname": "caryatid\n",
    "etc/machine-id": "",  # One of its own at each start: nothing is kept that would need it.
    "etc/fstab": "",  # All is mounted by init.
    # 14 s: the Raspberry Pi's timer cannot more than 15.
    "etc/systemd/system.conf.d/caryatid.conf":
        "[Manager]\nRuntimeWatchdogSec=14\nRebootWatchdogSec=14\nShowStatus=no\n",
    "etc/systemd/journald.conf.d/caryatid.conf": "[Journal]\nStorage=volatile\nRuntimeMaxUse=16M\n",
    "etc/systemd/system/caryatid.service.d/image.conf":
        "[Service]\nEnvironmentFile=-/data/kiosk.env\n",
    # For the test and for a technician: systemd.wants=caryatid-shell@hvc0.service on the kernel's
    # command line, which only who holds the card can change.
    "etc/systemd/system/caryatid-shell@.service":
        "[Unit]\nDescription=Root shell on %i\nDefaultDependencies=no\n"
        "StartLimitIntervalSec=0\n"  # Its line may come late.
        "[Service]\nExecStart=/bin/sh\nStandardInput=tty\nStandardOutput=tty\nStandardError=tty\n"
        "TTYPath=/dev/%i\nRestart=always\nRestartSec=1\n",
}
# Nothing here is of use to a kiosk without a network and with a root that cannot change.
MASKED = """
systemd-networkd.service systemd-resolved.service systemd-timesyncd.service
systemd-hwdb-update.service ldconfig.service systemd-update-done.service systemd-firstboot.service
systemd-pstore.service systemd-random-seed.service systemd-machine-id-commit.service
systemd-journal-catalog-update.service systemd-sysusers.service getty.target
getty@tty1.service ctrl-alt-del.target fstrim.timer e2scrub_all.timer e2scrub_reap.service
""".split()
DROPPED = """
usr/share/doc usr/share/man usr/share/info usr/share/locale usr/share/lintian usr/share/bug
usr/share/X11 usr/share/zsh usr/share/bash-completion usr/lib/udev/hwdb.d usr/lib/systemd/boot
usr/lib/systemd/catalog usr/lib/raspi-firmware usr/share/raspi-firmware boot etc/kernel
etc/initramfs var/cache/apt var/lib/apt var/lib/dpkg etc/apt
""".split()

CMDLINE = (f"caryatid.disk={DISK_ID:08x} caryatid.root=5 quiet loglevel=3 panic=10 "
           "vt.global_cursor_default=0 consoleblank=0 net.ifnames=0")
AUTOBOOT = "[all]\ntryboot_a_b=1\nboot_partition=2\n[tryboot]\nboot_partition=3\n"
# As Debian's raspi-firmware writes it, with what a kiosk's screen wants.
CONFIG = ("arm_64bit=1\nenable_uart=1\nupstream_kernel=1\nkernel=vmlinuz\ninitramfs initramfs.img\n"
          "disable_splash=1\ndisable_overscan=1\nboot_delay=0\n")


def run(*command, **options):
    subprocess.run(command, check=True, **options)


def write(root, path, text, mode=0o644):
    target = os.path.join(root, path)
    os.makedirs(os.path.dirname(target), exist_ok=True)
    with open(target, "w", encoding="utf-8") as file:
        file.write(text)
    os.chmod(target, mode)


def modules_folder(root):
    return glob.glob(os.path.join(root, "lib/modules/*"))[0]


def modules_of(root, patterns):
    """Paths of the modules that match, and of all that they need."""
    wanted = re.compile("kernel/(" + "|".join(patterns) + ")")
    needs = {}
    with open(os.path.join(modules_folder(root), "modules.dep"), encoding="utf-8") as table:
        for line in table:
            path, rest = line.rstrip("\n").split(":")
            needs[path] = rest.split()
    keep = set()
    for path, needed in needs.items():
        if wanted.match(path):
            keep.update([path, *needed])
    return keep


def depmod(root):
    run("depmod", "-b", root, os.path.basename(modules_folder(root)))


def prune_modules(root):
    depmod(root)
    folder = modules_folder(root)
    keep = modules_of(root, DRIVERS)
    for path in glob.glob(os.path.join(folder, "kernel/**/*.ko*"), recursive=True):
        if os.path.relpath(path, folder) not in keep:
            os.remove(path)
    depmod(root)


def touch_all(root):
    """One date for all, so that images can be compared."""
    for base, folders, files in os.walk(root):
        for name in folders + files:
            os.utime(os.path.join(base, name), (EPOCH, EPOCH), follow_symlinks=False)
    os.utime(root, (EPOCH, EPOCH))


def make_initramfs(root, out):
    scratch = out + ".tree"
    shutil.rmtree(scratch, ignore_errors=True)
    for folder in ("bin", "dev", "proc", "sys", "whole", "lower", "upper"):
        os.makedirs(os.path.join(scratch, folder))
    shutil.copy(os.path.join(root, "bin/busybox"), os.path.join(scratch, "bin/busybox"))
    shutil.copy(os.path.join(HERE, "init"), os.path.join(scratch, "init"))
    source = modules_folder(root)
    target = os.path.join(scratch, "lib/modules", os.path.basename(source))
    for path in sorted(modules_of(root, EARLY)) + [
            "modules.builtin", "modules.builtin.modinfo", "modules.order"]:
        os.makedirs(os.path.dirname(os.path.join(target, path)), exist_ok=True)
        shutil.copy(os.path.join(source, path), os.path.join(target, path))
    depmod(scratch)
    touch_all(scratch)
    names = sorted(os.path.relpath(os.path.join(base, name), scratch)
                   for base, folders, files in os.walk(scratch) for name in folders + files)
    archive = subprocess.run(["cpio", "-o", "-H", "newc", "--quiet", "--reproducible", "-R", "0:0"],
                             input="\n".join(names).encode(), cwd=scratch, capture_output=True,
                             check=True).stdout
    with open(out, "wb") as file:
        run("gzip", "-9n", input=archive, stdout=file)
    shutil.rmtree(scratch)


def collect_boot(root, boot):
    """What the firmware reads, for either boot partition, and what lies before both."""
    firmware = os.path.join(root, "usr/lib/raspi-firmware")
    slot, start = os.path.join(boot, "slot"), os.path.join(boot, "start")
    os.makedirs(os.path.join(slot, "EFI/BOOT"))
    os.makedirs(os.path.join(slot, "loader/entries"))
    os.makedirs(start)
    shutil.copy(os.path.join(firmware, "bootcode.bin"), start)
    for name in ("start.elf", "fixup.dat", "start4.elf", "fixup4.dat"):
        shutil.copy(os.path.join(firmware, name), slot)
    for path in glob.glob(os.path.join(root, "usr/lib/linux-image-*/broadcom/bcm*.dtb")):
        shutil.copy(path, slot)
    shutil.copy(glob.glob(os.path.join(root, "boot/vmlinuz-*"))[0], os.path.join(slot, "vmlinuz"))
    shutil.copy(os.path.join(root, "usr/lib/systemd/boot/efi/systemd-bootaa64.efi"),
                os.path.join(slot, "EFI/BOOT/BOOTAA64.EFI"))
    make_initramfs(root, os.path.join(slot, "initramfs.img"))
    write(start, "autoboot.txt", AUTOBOOT)
    write(slot, "config.txt", CONFIG)
    write(slot, "cmdline.txt", "console=ttyS1,115200 " + CMDLINE + "\n")
    write(slot, "loader/loader.conf", "timeout 0\n")
    write(slot, "loader/entries/kiosk.conf", "title Caryatid\nlinux /vmlinuz\n"
          "initrd /initramfs.img\noptions console=ttyAMA0 " + CMDLINE + "\n")


def emulate(root, program, *arguments, library_path=True):
    """Runs one of the tree's own programs, so that any host will do."""
    prefix = ["qemu-aarch64-static"] + (["-L", root] if library_path else [])
    # fakeroot's library is none of the board's.
    environment = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}
    run(*prefix, os.path.join(root, program), *arguments, stdout=subprocess.DEVNULL,
        env=environment)


def prepare(root):
    prune_modules(root)
    boot = root + ".boot"
    shutil.rmtree(boot, ignore_errors=True)
    collect_boot(root, boot)
    shutil.move(boot, os.path.join(root, "boot.parts"))
    for path in DROPPED:
        shutil.rmtree(os.path.join(root, path), ignore_errors=True)
    for path in glob.glob(os.path.join(root, "usr/lib/linux-image-*")):
        shutil.rmtree(path)
    for folder in ("proc", "sys", "run", "root", "dev", "tmp", "data", "var/log",
                   "var/lib/caryatid", "var/cache/caryatid", "etc/caryatid"):
        os.makedirs(os.path.join(root, folder), exist_ok=True)
    # In place of base-passwd's and libc-bin's scripts.
    for name in ("passwd", "group"):
        shutil.copy(os.path.join(root, "usr/share/base-passwd", name + ".master"),
                    os.path.join(root, "etc", name))
    shutil.copy(os.path.join(root, "usr/share/libc-bin/nsswitch.conf"), os.path.join(root, "etc"))
    for link, target in (("etc/mtab", "/proc/self/mounts"), ("var/run", "/run"),
                         ("var/lock", "/run/lock")):
        shutil.rmtree(os.path.join(root, link), ignore_errors=True)
        os.symlink(target, os.path.join(root, link))
    for path, text in FILES.items():
        write(root, path, text)
    units = os.path.join(root, "etc/systemd/system")
    for unit in MASKED:
        os.symlink("/dev/null", os.path.join(units, unit))
    os.symlink("/lib/systemd/system/multi-user.target", os.path.join(units, "default.target"))
    shell = os.path.join(root, "usr/bin/sh")
    if not os.path.exists(shell):
        os.symlink("busybox", shell)


def add_payload(root, payload):
    run("cp", "-a", "--remove-destination", payload + "/.", root)
    shutil.rmtree(os.path.join(root, "usr/share/doc"), ignore_errors=True)
    shutil.rmtree(os.path.join(root, "usr/share/man"), ignore_errors=True)
    emulate(root, "usr/bin/systemd-sysusers", "--root=" + root)
    emulate(root, "sbin/ldconfig", "-r", root, "-X", library_path=False)
    wants = os.path.join(root, "etc/systemd/system/multi-user.target.wants")
    os.makedirs(wants, exist_ok=True)
    os.symlink("/lib/systemd/system/caryatid.service", os.path.join(wants, "caryatid.service"))


def make_fat(folder, out, size_mib, volume):
    with open(out, "wb") as file:
        file.truncate(size_mib * MIB)
    kind = "32" if size_mib >= 64 else "12"
    run("mkfs.vfat", "-F", kind, "--invariant", "-i", volume, "-n", "CARYATID", out,
        stdout=subprocess.DEVNULL)
    touch_all(folder)
    run("mcopy", "-s", "-p", "-m", "-i", out, *sorted(glob.glob(os.path.join(folder, "*"))), "::",
        env={**os.environ, "TZ": "UTC"})


def make_root(root, out):
    if os.path.exists(out):
        os.remove(out)
    run("mksquashfs", root, out, "-quiet", "-no-progress", "-comp", "zstd",
        "-Xcompression-level", "12", "-b", "256K", "-no-xattrs", "-processors", "2",
        stdout=subprocess.DEVNULL, env={**os.environ, "SOURCE_DATE_EPOCH": str(EPOCH)})


def make_data(root, out, size_mib):
    scratch = out + ".tree"
    shutil.rmtree(scratch, ignore_errors=True)
    for folder in ("state", "cache"):
        os.makedirs(os.path.join(scratch, folder), mode=0o700)
    shutil.copytree(os.path.join(root, "etc/caryatid"), os.path.join(scratch, "programme"))
    write(scratch, "kiosk.env", "# Read by the kiosk's service. Opening hours are in this zone.\n"
          "TZ=UTC\n")
    touch_all(scratch)
    if os.path.exists(out):
        os.remove(out)
    run("mke2fs", "-q", "-F", "-t", "ext4", "-L", "caryatid-data", "-U", DATA_UUID, "-E",
        f"hash_seed={DATA_UUID},root_owner=0:0", "-d", scratch, out, f"{size_mib}M",
        env={**os.environ, "E2FSPROGS_FAKE_TIME": str(EPOCH)})
    shutil.rmtree(scratch)


def assemble(parts, out):
    """The partition table, and each part at its place; what is empty stays a hole."""
    if os.path.exists(out):
        os.remove(out)
    with open(out, "wb") as file:
        file.truncate(SIZE_MIB * MIB)
    lines = [f"label: dos\nlabel-id: 0x{DISK_ID:08x}\nunit: sectors"]
    for name, number, kind, first, size in PARTITIONS:
        lines.append(f"{number}: start={first * 2048}, size={size * 2048}, type={kind}"
                     + (", bootable" if number == 2 else ""))
    run("sfdisk", "-q", out, input="\n".join(lines).encode())
    for name, number, kind, first, size in PARTITIONS:
        if name not in parts:
            continue
        length = os.path.getsize(parts[name])
        if length > size * MIB:
            sys.exit(f"{name}: {length / MIB:.0f} MiB do not fit into {size}")
        run("dd", "if=" + parts[name], "of=" + out, "bs=1M", f"seek={first}", "conv=notrunc,sparse",
            "status=none")


def biggest(root, count=6):
    """The `count` folders that weigh most; hard links count once."""
    sizes, seen = {}, set()
    for base, _, files in os.walk(root):
        top = "/".join(os.path.relpath(base, root).split("/")[:3])
        for name in files:
            path = os.path.join(base, name)
            number = os.lstat(path).st_ino
            if not os.path.islink(path) and number not in seen:
                seen.add(number)
                sizes[top] = sizes.get(top, 0) + os.path.getsize(path)
    return sorted(sizes.items(), key=lambda item: -item[1])[:count]


def report(tree, boot, parts, out):
    lines = []
    for name, number, _, _, size in PARTITIONS:
        if name in parts:
            used = os.path.getsize(parts[name])
            lines.append(f"partition {number} {name:6} {used / MIB:7.1f} MiB of {size}")
    for title, folder in (("boot A", boot), ("root A, before compression", tree)):
        lines.append(f"{title}: " + ", ".join(f"{name} {size / MIB:.1f}"
                                              for name, size in biggest(folder)))
    for path in (out, out + ".zst"):
        blocks = os.stat(path).st_blocks * 512
        lines.append(f"{os.path.basename(path)}: {blocks / MIB:.1f} MiB on disk")
    text = "\n".join(lines) + "\n"
    write(os.path.dirname(out), "size.txt", text)
    print(text, end="")


def image(root, payload, out):
    os.makedirs(out, exist_ok=True)
    tree = os.path.join(out, "tree")
    shutil.rmtree(tree, ignore_errors=True)
    run("cp", "-a", root, tree)
    boot = os.path.join(out, "boot")
    shutil.rmtree(boot, ignore_errors=True)
    shutil.move(os.path.join(tree, "boot.parts"), boot)
    add_payload(tree, payload)
    touch_all(tree)
    sizes = {name: size for name, _, _, _, size in PARTITIONS}
    parts = {name: os.path.join(out, file) for name, file in
             {"start": "start.vfat", "boot A": "boot.vfat", "root A": "root.squashfs",
              "data": "data.ext4"}.items()}
    make_fat(os.path.join(boot, "start"), parts["start"], sizes["start"], "ca47a701")
    make_fat(os.path.join(boot, "slot"), parts["boot A"], sizes["boot A"], "ca47a702")
    make_root(tree, parts["root A"])
    make_data(tree, parts["data"], sizes["data"])
    kiosk = os.path.join(out, "kiosk.img")
    assemble(parts, kiosk)
    run("zstd", "-q", "-f", "-T2", "-6", kiosk, "-o", kiosk + ".zst")
    report(tree, os.path.join(boot, "slot"), parts, kiosk)
    shutil.rmtree(tree)


def main():
    if len(sys.argv) == 3 and sys.argv[1] == "prepare":
        prepare(sys.argv[2])
    elif len(sys.argv) == 5 and sys.argv[1] == "image":
        image(*sys.argv[2:])
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
