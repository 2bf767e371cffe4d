#!/bin/busybox sh
# PID 1 of the board whose power is cut: starts the kiosk again and again, and each start and each
# end writes its state. What stands in the file after power-on is told before anything is written.
export PATH=/bin:/usr/bin
mount -t proc proc /proc
mount -t sysfs sys /sys
mount -t tmpfs run /run
state=/var/lib/caryatid
mkdir -p $state
tell() { echo "$1 $(cat $state/* 2>/dev/null | tr '\n' ' ')" >/dev/ttyAMA0; }
tell found
while true; do
  caryatid --display none --audio null --duration 0.3 --state $state >/dev/ttyAMA0 2>&1
  sync
  tell wrote
done
