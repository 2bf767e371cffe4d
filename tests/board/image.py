#!/usr/bin/env python3
"""The kiosk's disk image: what a Raspberry Pi's firmware looks for, and two starts on the emulated
board. ./cross/board.sh image try runs it."""

import argparse
import json
import os
import subprocess
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "../../cross/board"))
sys.path.insert(0, os.path.dirname(__file__))
from machine import Machine, Timeout, wait_for  # noqa: E402
from pictures import read_ppm  # noqa: E402

PATIENCE = float(os.environ.get("CARYATID_BOARD_PATIENCE", "1"))
MIB = 1 << 20
SHELL = " systemd.wants=caryatid-shell@hvc0.service"
KEPT = "/var/lib/caryatid/of-the-test"
LOST = "/usr/of-the-test"


def check(holds, what):
    print(("image: " if holds else "image: FAILED: ") + what, flush=True)
    if not holds:
        sys.exit(1)


def output(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def read_fat(disk, first_mib, path):
    return output("mtype", "-i", f"{disk}@@{first_mib}M", "::" + path)


def check_layout(disk):
    table = json.loads(output("sfdisk", "-J", disk))["partitiontable"]
    starts = [part["start"] * 512 // MIB for part in table["partitions"]]
    types = [part["type"] for part in table["partitions"]]
    check(table["label"] == "dos" and types == ["c", "c", "c", "f", "83", "83", "83"],
          f"partitions at {starts} MiB")
    check("boot_partition=2" in read_fat(disk, starts[0], "autoboot.txt"),
          "the Raspberry Pi's firmware is led to boot partition A")
    config = dict(line.split("=", 1) for line in read_fat(disk, starts[1], "config.txt").split()
                  if "=" in line)
    names = output("mdir", "-b", "-i", f"{disk}@@{starts[1]}M", "::").split()
    wanted = ["start.elf", "fixup.dat", "start4.elf", "fixup4.dat", "cmdline.txt",
              "initramfs.img", config["kernel"], "bcm2837-rpi-zero-2-w.dtb",
              "bcm2837-rpi-3-b.dtb", "bcm2837-rpi-3-b-plus.dtb", "bcm2711-rpi-4-b.dtb"]
    missing = [name for name in wanted if "::/" + name not in names]
    check(not missing and config["arm_64bit"] == "1",
          f"firmware, kernel, device trees of Zero 2 W, 3 and 4 {missing or ''}")
    check(f"caryatid.disk={table['id'][2:]}" in read_fat(disk, starts[1], "cmdline.txt"),
          "the kernel is told this disk")
    return starts


def check_file_systems(out):
    for name in ("start.vfat", "boot.vfat"):
        subprocess.run(["fsck.vfat", "-n", os.path.join(out, name)], check=True,
                       stdout=subprocess.DEVNULL)
    subprocess.run(["e2fsck", "-fn", os.path.join(out, "data.ext4")], check=True,
                   capture_output=True)
    check("squashfs" in output("unsquashfs", "-s", os.path.join(out, "root.squashfs")).lower(),
          "every file system is sound")


def colours(path):
    rgb = read_ppm(path).rgb
    return len(set(zip(rgb[0::3], rgb[1::3], rgb[2::3])))


def wait_shell(board):
    """A line and its answer take long on a busy machine: ask seldom."""
    def answers():
        try:
            return board.run("stty -echo -onlcr; PS1=; PS2=; echo ready", 30).endswith("ready")
        except Timeout:
            return False
    wait_for("the board's shell", 300 * PATIENCE, answers)


def wait_person(board, name):
    """Until the kiosk says that it draws the pack's person; its picture."""
    def drawn():
        text = board.run("cat /run/caryatid/status.json 2>/dev/null")
        return text.startswith("{") and json.loads(text).get("frames", 0) > 30
    wait_for("the kiosk", 400 * PATIENCE, drawn, 2)
    # Her way into the picture, at the emulated board's pace.
    time.sleep(20)
    return board.picture(name)


def start(out, disk, extra=""):
    boot = os.path.join(out, "boot/slot")
    with open(os.path.join(boot, "cmdline.txt"), encoding="utf-8") as file:
        line = file.read().strip().replace("console=ttyS1,115200", "console=ttyAMA0")
    machine = Machine(out, os.path.join(boot, "vmlinuz"), os.path.join(boot, "initramfs.img"), disk)
    machine.command[machine.command.index("-append") + 1] = line + extra
    return machine


def first_boot(board):
    wait_shell(board)
    path = wait_person(board, "first")
    check(colours(path) > 500, f"the person is on the screen: {path}")
    mounts = board.run("cat /proc/mounts").splitlines()
    check(any(m.startswith("overlay / overlay") for m in mounts), "the root is an overlay")
    check(any(" /data ext4 rw" in m for m in mounts), "the data partition is there")
    for place in ("/var/lib/caryatid", "/var/cache/caryatid", "/etc/caryatid"):
        check(any(f" {place} ext4 rw" in m for m in mounts), f"{place} lies on it")
    check(board.run("systemctl is-system-running") in ("running", "starting"),
          "no unit failed" + board.run("systemctl --failed --no-legend"))
    board.run(f"echo kept > {KEPT}; echo lost > {LOST}; echo '# kept' >> /etc/caryatid/kiosk.toml")
    check(board.run(f"cat {LOST}") == "lost", "the overlay takes what is written")
    states = board.run("ls /var/lib/caryatid")
    board.run("sync")
    return states


def second_boot(board, states):
    wait_shell(board)
    check(board.run(f"cat {KEPT}; tail -1 /etc/caryatid/kiosk.toml") == "kept\n# kept",
          f"after a power cut state and programme are as they were ({' '.join(states.split())})")
    check("No such file" in board.run(f"cat {LOST} 2>&1"), "and the root as it was delivered")
    check(colours(wait_person(board, "second")) > 500, "the person is there again")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", default="build/image")
    out = parser.parse_args().out
    delivered, disk = os.path.join(out, "kiosk.img"), os.path.join(out, "try.img")
    check_layout(delivered)
    check_file_systems(out)
    subprocess.run(["cp", "--sparse=always", delivered, disk], check=True)
    with start(out, disk, SHELL) as board:
        states = first_boot(board)
    with start(out, disk, SHELL) as board:
        second_boot(board, states)
    os.remove(disk)


if __name__ == "__main__":
    main()
