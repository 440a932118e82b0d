# shellcheck shell=bash
# Sourced by tools/faults.sh: the cases, each a function of a command that calls `try` and `meet` as often as it needs.

# What a disk that is full, a quota or a limit on memory leaves room for, in kB.
disks=(0 16 256 1024)
memories=(80000 100000 130000 180000 260000 340000 420000 600000)

full_disk() {
  can_mount || { skip "needs the right to mount a tmpfs" && return; }
  local size
  for size in "${disks[@]}"; do
    begin "$1"
    mount -t tmpfs -o "size=$((size + 4))k" none out
    try
    meet "on $size kB" 0 1 2
    umount out
  done
}

read_only_folder() {
  begin "$1"
  local as=()
  [ "$(id -u)" -ne 0 ] || as=(setpriv --reuid 65534 --clear-groups)
  chmod 555 out
  prefix=("${as[@]}")
  try
  chmod 755 out
  meet "as $(id -un)" 1
}

quota() {
  local size
  for size in "${disks[@]}"; do
    begin "$1"
    # What it says goes through a pipe, which has no limit.
    (ulimit -f "$size" && run_job) 2>&1 >/dev/null | cat >said.log
    code=${PIPESTATUS[0]}
    meet "of $size kB a file" 0 1 2
  done
}

memory() {
  local size
  for size in "${memories[@]}"; do
    begin "$1"
    (ulimit -v "$size" && run_job >/dev/null 2>said.log) || code=$?
    meet "of $size kB" 0 1 2
  done
}

closed_streams() {
  begin "$1"
  run_job >&- 2>said.log || code=$?
  meet "without a standard output" 1 0
  is_whole
  begin "$1"
  run_job 2>&- >/dev/null || code=$?
  says=""
  meet "without a standard error" 0 2
  is_whole
  begin "$1"
  run_job <&- >&- 2>&- || code=$?
  says=""
  meet "without any stream" 0 1 2
  is_whole
}

full_streams() {
  begin "$1"
  run_job >/dev/full 2>said.log || code=$?
  meet "to a standard output that is full" 0 1 2
  is_whole
  begin "$1"
  run_job >/dev/null 2>/dev/full || code=$?
  says=""
  meet "to a standard error that is full" 0 2
  is_whole
  begin "$1"
  { run_job 2>said.log || echo $? >code.log; } | head -1 >/dev/null
  code=$(cat code.log 2>/dev/null || echo 0)
  meet "| head -1" 0 2
  is_whole
}

strange_outputs() {
  local kind
  for kind in folder pipe device file_as_folder long_name; do
    begin "$1"
    case $kind in
      folder) if takes_folder "$1"; then touch "$output"; else mkdir "$output"; fi ;;
      pipe) mkfifo "$output" ;;
      device) ln -s /dev/full "$output" ;;
      file_as_folder) touch out/file && relocate "out/file/$(basename "$output")" ;;
      long_name) relocate "out/$(printf 'n%.0s' $(seq 300)).$(basename "$output")" ;;
    esac
    before=$(ls -R out)
    try
    [ "$kind" = device ] && takes_folder "$1" || meet_refusal "$kind"
  done
}

# Both write all of it, or one says that the other is writing.
two_runs() {
  local first second
  for _ in 1 2 3; do
    begin "$1"
    run_job >/dev/null 2>said.log &
    first=$!
    second=0
    run_job >/dev/null 2>second.log || second=$?
    wait "$first" || code=$?
    meet "the first of two" 0 1 2
    code=$second
    cp second.log said.log
    meet "the second of two" 0 1 2
    is_whole
  done
}

clock_goes_back() {
  local faketime
  faketime=$(ls /usr/lib/*/faketime/libfaketimeMT.so.1 2>/dev/null | head -1 || true)
  [ -n "$faketime" ] || { skip "needs libfaketime (Debian package faketime)" && return; }
  begin "$1"
  echo "2026-01-01 00:00:00" >clock
  (sleep 0.05 && echo "1999-01-01 00:00:00" >clock) &
  prefix=(env "LD_PRELOAD=$faketime" "FAKETIME_TIMESTAMP_FILE=$PWD/clock" FAKETIME_NO_CACHE=1 DONT_FAKE_MONOTONIC=1)
  try
  wait
  meet "by years" 0 2
  is_whole
}

# What the command reads loses its end, comes back and vanishes while it reads.
changing_files() {
  local input=knee.toml bytes moment
  case $1 in
    new | import | export | plot | render | report) input=$(input_of "$1") ;;
    simulate) input=motion.toml ;;
    laxity) input=drawer.toml ;;
    calibrate) input=laxity.csv ;;
    study | compare) input=wismans.toml ;;
  esac
  for input in "$input" femur.stl; do
    [[ $input != femur.stl ]] || reads_mesh "$1" || continue
    for moment in 0.002 0.01 0.05 0.2; do
      begin "$1"
      cp "$input" kept
      bytes=$(stat -c %s kept)
      (sleep "$moment" && truncate -s $((bytes / 2)) "$input" && sleep 0.01 && cp kept "$input" && sleep 0.01 && rm "$input") &
      try
      wait
      cp kept "$input"
      meet "$input after $moment s" 0 1 2
    done
  done
}

signals() {
  local signal part process
  for signal in INT TERM HUP; do
    for part in 15 40 65 90; do
      begin "$1"
      env --default-signal="$signal" "$CONDYLE" "${words[@]}" >/dev/null 2>said.log &
      process=$!
      sleep "$(awk -v p="$part" -v w="$whole_seconds" 'BEGIN { print p * w / 100 }')"
      says=$(listens "$process" && echo line)
      kill -"$signal" "$process" 2>/dev/null || true
      wait "$process" 2>/dev/null || code=$?
      meet "SIG$signal at $part %" 0 2 129 130 143
    done
  done
}
