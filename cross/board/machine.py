"""The emulated board: QEMU's `virt` machine with the devices of a kiosk, driven from outside.

The test on the host presses, plugs and pulls by QEMU's machine protocol (QMP) and looks inside
through a root shell on a serial line of its own. Nothing in the program under test knows of it.

The board's time: its clock moves by one nanosecond for each instruction of either core, and with
the PC's clock while both cores wait (QEMU's -icount shift=0). So the board is one of 1000 million
instructions a second, about a Raspberry Pi Zero 2 W with one core in use, however busy the PC is;
only what waits for the PC's disk takes the PC's time.
"""

import json
import os
import socket
import subprocess
import threading
import time


# How long this PC may take for an answer of QEMU or of the board's shell: a guard against hanging.
ANSWER_S = 600


class Timeout(Exception):
    """Something did not happen in time."""


def wait_for(what, seconds, probe, pause=0.25):
    """Calls `probe` until it gives something; returns that."""
    end = time.monotonic() + seconds
    while True:
        found = probe()
        if found:
            return found
        if time.monotonic() > end:
            raise Timeout(f"{what}: not within {seconds} s")
        time.sleep(pause)


def connect(path):
    link = socket.socket(socket.AF_UNIX)
    link.settimeout(ANSWER_S)
    link.connect(path)
    return link


class Machine:
    """One run of the board. Use with `with`: it ends when that ends."""

    def __init__(self, folder, kernel, initramfs, disk, size=(320, 240)):
        self.folder = folder
        self.log = os.path.join(folder, "console.log")
        self.qmp_path = os.path.join(folder, "qmp")
        self.shell_path = os.path.join(folder, "shell")
        self.sound = os.path.join(folder, "sound.wav")
        self.marks = 0
        self.events = []
        for path in (self.qmp_path, self.shell_path, self.log):
            if os.path.exists(path):
                os.remove(path)
        self.command = [
            "nice", "-n", "5", "qemu-system-aarch64", "-M", "virt", "-cpu", "cortex-a53",
            "-smp", "2", "-icount", "shift=0", "-m", "1024", "-display", "none",
            "-nodefaults", "-no-user-config",
            "-kernel", kernel, "-initrd", initramfs,
            "-append", "console=ttyAMA0 quiet loglevel=4 panic=5 vt.global_cursor_default=0",
            "-drive", f"file={disk},if=none,id=disk,format=raw,cache=writethrough",
            "-device", "virtio-blk-pci,drive=disk",
            "-device", f"virtio-gpu-pci,id=gpu,xres={size[0]},yres={size[1]}",
            "-device", "qemu-xhci,id=xhci", "-device", "usb-kbd,id=kbd,bus=xhci.0",
            "-audiodev", f"wav,id=sound,path={self.sound}",
            "-device", "usb-audio,audiodev=sound,bus=xhci.0",
            "-device", "i6300esb", "-action", "watchdog=reset",
            "-serial", f"file:{self.log}",
            "-device", "virtio-serial-pci",
            "-chardev", f"socket,id=shell,path={self.shell_path},server=on,wait=off",
            "-device", "virtconsole,chardev=shell",
            "-qmp", f"unix:{self.qmp_path},server=on,wait=off"]

    def __enter__(self):
        with open(os.path.join(self.folder, "qemu.log"), "w", encoding="utf-8") as log:
            self.process = subprocess.Popen(self.command, stdin=subprocess.DEVNULL, stderr=log)
        wait_for("QEMU", 20, lambda: os.path.exists(self.qmp_path) or self.process.poll())
        time.sleep(0.2)
        if self.process.poll() is not None:
            raise Timeout(f"QEMU does not start; see {self.folder}/qemu.log")
        self.started = time.monotonic()
        self.link = connect(self.qmp_path)
        self.link.settimeout(None)  # Minutes may pass between two events.
        self.answers = []
        self.arrived = threading.Condition()
        threading.Thread(target=self._listen, args=(self.link,), daemon=True).start()
        self.shell_link = connect(self.shell_path)
        self.heard = ""
        self.qmp("qmp_capabilities")
        return self

    def __exit__(self, *error):
        self.cut_power()

    def cut_power(self):
        """As if the plug were pulled: no more is written than was."""
        self.process.kill()
        self.process.wait()

    def _listen(self, link):
        try:
            for line in link.makefile():
                message = json.loads(line)
                with self.arrived:
                    if "event" in message:
                        self.events.append((time.monotonic(), message["event"], message))
                    elif "QMP" not in message:
                        self.answers.append(message)
                    self.arrived.notify_all()
        except (OSError, ValueError):
            pass

    def qmp(self, command, **arguments):
        with self.arrived:
            self.answers.clear()
            text = json.dumps({"execute": command, "arguments": arguments})
            self.link.sendall(text.encode() + b"\n")
            self.arrived.wait_for(lambda: self.answers, ANSWER_S)
            if not self.answers or "error" in self.answers[0]:
                raise Timeout(f"QMP {command}: {self.answers[:1]}")
            return self.answers[0]["return"]

    def happened(self, event):
        return any(name == event for _, name, _ in self.events)

    def events_of(self, event):
        return sum(name == event for _, name, _ in self.events)

    # What a visitor or a careless cleaner does.

    def press_button(self):
        """The power key: 100 ms down on GPIO line 3."""
        self.qmp("system_powerdown")

    def type_key(self, name):
        self.qmp("send-key", keys=[{"type": "qcode", "data": name}])

    def unplug_keyboard(self):
        self.qmp("device_del", id="kbd")

    def plug_keyboard(self):
        self.qmp("device_add", driver="usb-kbd", id="kbd", bus="xhci.0")

    def plug_screen(self, plugged):
        """By the kernel's switch: QEMU's own screen has no plug."""
        state = "detect" if plugged else "off"
        self.run(f"echo {state} >/sys/class/drm/card0-Virtual-1/status")

    def picture(self, name):
        """What is scanned out now, as a PPM file; its path."""
        path = os.path.join(self.folder, name + ".ppm")
        self.qmp("screendump", filename=path)
        return path

    # What the test asks inside.

    def run(self, command, seconds=ANSWER_S):
        """A line for the board's shell; what it writes."""
        self.marks += 1
        mark = f"mark{self.marks}"
        # The mark is put together by the shell, so that the echo of the line isn't taken for it.
        self.shell_link.sendall(f"{command}; echo m\"\"{mark[1:]}:$?\n".encode())
        self.shell_link.settimeout(0.5)
        end = time.monotonic() + seconds
        while f"\n{mark}:" not in "\n" + self.heard.replace("\r", ""):
            if time.monotonic() > end:
                raise Timeout(f"the board's shell does not answer to: {command}")
            try:
                self.heard += self.shell_link.recv(65536).decode("utf-8", "replace")
            except TimeoutError:
                pass
        text = ("\n" + self.heard.replace("\r", "")).split(f"\n{mark}:")[0]
        self.heard = ""
        return text.strip("\n")

    def shell_ready(self, seconds):
        """Waits for the shell and stops its echo."""
        def answers():
            try:
                self.run("stty -echo -onlcr; PS1=; PS2=", 3)
                return True
            except (Timeout, TimeoutError):
                return False
        wait_for("the board's shell", seconds, answers)
        self.run("true")

    def console(self):
        with open(self.log, encoding="utf-8", errors="replace") as file:
            return file.read()
