#!/usr/bin/env python3
"""Makes the emulated board's disk from an unpacked Debian tree: packages unpacked, no script run.

tree.py prepare TREE            once per tree: users, modules, initramfs, settings of a test board
tree.py disk TREE PAYLOAD OUT   TREE with the files of PAYLOAD (a folder like /) as an ext4 image
"""

import glob
import os
import shutil
import subprocess
import sys

# What the machine of machine.py is made of. Modules that these need come along. gpio_keys is left
# out on purpose: it would hold the line that the kiosk's button is on.
EARLY = ["virtio_pci", "virtio_blk", "crc32c_generic", "ext4"]
MODULES = EARLY + ["virtio_console", "virtio-gpu", "xhci-pci", "usbhid", "hid-generic", "i6300esb",
                   "snd-usb-audio"]

INIT = """#!/bin/busybox sh
export PATH=/bin
/bin/busybox --install -s /bin
mount -t devtmpfs dev /dev
mount -t proc proc /proc
mount -t sysfs sys /sys
for module in $(cat /modules/order); do insmod /modules/$module; done
mount -t ext4 /dev/vda /disk || exec sh
umount /sys /proc
mount --move /dev /disk/dev
exec switch_root /disk $(cat /init.next)
"""

SHELL_UNIT = """[Unit]
Description=Root shell for the test on the host
DefaultDependencies=no
After=systemd-udevd.service
[Service]
ExecStart=/bin/busybox sh
StandardInput=tty
StandardOutput=tty
StandardError=tty
TTYPath=/dev/hvc0
Restart=always
"""

FILES = {
    "etc/hostname": "board\n",
    "etc/machine-id": "00000000000000000000000000000001\n",
    "etc/passwd": "root:x:0:0:root:/:/bin/sh\n",
    "etc/group": "root:x:0:\n",
    "etc/fstab": "",
    "etc/modules-load.d/board.conf": "\n".join(m.replace("-", "_") for m in MODULES) + "\n",
    "etc/systemd/system/host-shell.service": SHELL_UNIT,
    "etc/systemd/system.conf.d/watchdog.conf":
        "[Manager]\nRuntimeWatchdogSec=15\nShowStatus=no\n",
    "etc/systemd/journald.conf.d/board.conf":
        "[Journal]\nStorage=volatile\nForwardToConsole=yes\nTTYPath=/dev/ttyAMA0\n",
}
WANTED = ["host-shell.service"]
# Nothing here is of use on a board that is only tested.
MASKED = ["systemd-networkd.service", "systemd-resolved.service", "systemd-timesyncd.service",
          "systemd-hwdb-update.service", "ldconfig.service", "systemd-update-done.service",
          "systemd-firstboot.service", "systemd-pstore.service", "getty.target",
          "serial-getty@ttyAMA0.service", "getty@tty1.service", "systemd-random-seed.service",
          "ctrl-alt-del.target"]


def write(root, path, text, mode=0o644):
    target = os.path.join(root, path)
    os.makedirs(os.path.dirname(target), exist_ok=True)
    with open(target, "w", encoding="utf-8") as file:
        file.write(text)
    os.chmod(target, mode)


def version_of(root):
    return os.listdir(os.path.join(root, "lib/modules"))[0]


def needs(root, names):
    """The modules `names` and all that they need, each behind its needs, as paths."""
    folder = os.path.join(root, "lib/modules", version_of(root))
    needed_by, path_of = {}, {}
    with open(os.path.join(folder, "modules.dep"), encoding="utf-8") as table:
        for line in table:
            path, rest = line.rstrip("\n").split(":")
            needed_by[path] = rest.split()
            path_of[os.path.basename(path).split(".")[0].replace("_", "-")] = path
    ordered = []
    for name in names:
        path = path_of[name.replace("_", "-")]
        # depmod lists the nearest need first and the deepest last.
        for module in reversed([path] + needed_by[path]):
            if module not in ordered:
                ordered.append(module)
    return ordered


def prune_modules(root):
    subprocess.run(["depmod", "-b", root, version_of(root)], check=True)
    folder = os.path.join(root, "lib/modules", version_of(root))
    keep = {os.path.join(folder, path) for path in needs(root, MODULES)}
    for path in glob.glob(os.path.join(folder, "kernel/**/*.ko*"), recursive=True):
        if path not in keep:
            os.remove(path)
    subprocess.run(["depmod", "-b", root, version_of(root)], check=True)


def make_initramfs(root, out, next_init):
    """A busybox that loads the disk's driver and hands over to `next_init` on the disk."""
    scratch = out + ".tree"
    shutil.rmtree(scratch, ignore_errors=True)
    for folder in ("bin", "dev", "proc", "sys", "disk", "modules"):
        os.makedirs(os.path.join(scratch, folder))
    shutil.copy(os.path.join(root, "bin/busybox"), os.path.join(scratch, "bin/busybox"))
    order = []
    for path in needs(root, EARLY):
        shutil.copy(os.path.join(root, "lib/modules", version_of(root), path),
                    os.path.join(scratch, "modules"))
        order.append(os.path.basename(path))
    write(scratch, "modules/order", "\n".join(order) + "\n")
    write(scratch, "init.next", next_init + "\n")
    write(scratch, "init", INIT, 0o755)
    names = sorted(os.path.relpath(os.path.join(base, name), scratch)
                   for base, folders, files in os.walk(scratch) for name in folders + files)
    with open(out, "wb") as file:
        subprocess.run(["cpio", "-o", "-H", "newc", "--quiet"], input="\n".join(names).encode(),
                       cwd=scratch, stdout=file, check=True)
    shutil.rmtree(scratch)


def prepare(root):
    prune_modules(root)
    boot = os.path.join(root, "boot")
    for name in os.listdir(boot):
        if not name.startswith("vmlinuz"):
            os.remove(os.path.join(boot, name))
    for path in ("usr/share/doc", "usr/share/man", "usr/share/locale", "usr/share/X11",
                 "usr/lib/udev/hwdb.d", "var/cache/apt", "var/lib/apt"):
        shutil.rmtree(os.path.join(root, path), ignore_errors=True)
    for folder in ("proc", "sys", "run", "root", "dev", "tmp", "var/log", "var/lib"):
        os.makedirs(os.path.join(root, folder), exist_ok=True)
    for path, text in FILES.items():
        write(root, path, text)
    units = os.path.join(root, "etc/systemd/system")
    for unit in WANTED:
        os.makedirs(os.path.join(units, "multi-user.target.wants"), exist_ok=True)
        os.symlink("../" + unit, os.path.join(units, "multi-user.target.wants", unit))
    for unit in MASKED:
        os.symlink("/dev/null", os.path.join(units, unit))
    os.symlink("/lib/systemd/system/multi-user.target", os.path.join(units, "default.target"))
    shutil.move(glob.glob(os.path.join(boot, "vmlinuz*"))[0], os.path.join(boot, "vmlinuz"))
    make_initramfs(root, os.path.join(boot, "initramfs"), "/lib/systemd/systemd")
    make_initramfs(root, os.path.join(boot, "initramfs-small"), "/etc/small-init")


def disk(root, payload, out):
    scratch = out + ".tree"
    shutil.rmtree(scratch, ignore_errors=True)
    # Hard links: the tree itself must not change, so what is written anew replaces its link.
    subprocess.run(["cp", "-al", root, scratch], check=True)
    for name in ("passwd", "group", "shadow", "gshadow"):
        path = os.path.join(scratch, "etc", name)
        if os.path.exists(path):
            text = open(path, encoding="utf-8").read()
            os.remove(path)
            write(scratch, "etc/" + name, text)
    subprocess.run(["cp", "-a", "--remove-destination", payload + "/.", scratch], check=True)
    # In place of the packages' scripts. The tree's own program, so that any host will do.
    subprocess.run(["qemu-aarch64-static", "-L", scratch,
                    os.path.join(scratch, "bin/systemd-sysusers"), "--root=" + scratch],
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    subprocess.run(["mke2fs", "-q", "-F", "-t", "ext4", "-d", scratch, out, "768M"], check=True)
    shutil.rmtree(scratch)


def main():
    if len(sys.argv) == 3 and sys.argv[1] == "prepare":
        prepare(sys.argv[2])
    elif len(sys.argv) == 5 and sys.argv[1] == "disk":
        disk(*sys.argv[2:])
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
