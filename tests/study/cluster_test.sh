#!/usr/bin/env bash
# A study by the ranks of mpirun. cluster_test.sh BUILD CASE, with CASE one of those below. Ends with 77 where MPI, h5py
# or what else a case needs is missing.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../tools/study/small_study.sh"
build=$(realpath "$1")
knee=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../../data/wismans-type/knee.toml")
condyle=$build/condyle condyle_mpi=$build/condyle-mpi
[ -x "$condyle_mpi" ] || { echo "skipped: $build holds no condyle-mpi (CONDYLE_MPI, libopenmpi-dev)" && exit 77; }
command -v mpirun >/dev/null || { echo "skipped: no mpirun (openmpi-bin)" && exit 77; }
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

fail() {
  echo "$*"
  cat ./*.log 2>/dev/null
  exit 1
}

mpi=(mpirun --oversubscribe --bind-to none)

# ranks N ARGUMENT...: condyle-mpi on N ranks.
ranks() {
  local n=$1
  shift
  "${mpi[@]}" -n "$n" "$condyle_mpi" "$@"
}

# under_way RESULT: waits until some MB of its chunks are in journals.
under_way() {
  for _ in $(seq 600); do
    [ "$(du -sb "$1.journal" 2>/dev/null | cut -f 1 || true)0" -lt 60000000 ] || return 0
    sleep 0.02
  done
  fail "there are no journals"
}

whole_study() {
  small_study "$knee" "$1" >study.toml
  "$condyle" study study.toml -o whole.h5 --threads 1 --quiet
}

# The plain program asks the loader for no MPI.
links() {
  ! ldd "$condyle" | grep -i 'libmpi\|open-rte\|open-pal' || fail "condyle is linked with MPI"
  ldd "$condyle_mpi" | grep -i libmpi >/dev/null || fail "condyle-mpi is not linked with MPI"
}

any_number_of_ranks() {
  whole_study 600
  for n in 1 2 3 7; do
    ranks "$n" study study.toml -o "$n.h5" >"$n.log" 2>&1 || fail "$n ranks: exit code $?"
    [ "$(grep -c '^wrote ' "$n.log")" -eq 1 ] || fail "$n ranks: not one of them alone said what it wrote"
    [ ! -e "$n.h5.journal" ] || fail "$n ranks: journals of a complete study are still there"
  done
  ranks 2 study study.toml -o threads.h5 --threads 2 >threads.log 2>&1 || fail "2 ranks of 2 threads: exit code $?"
  same_content whole.h5 1.h5 2.h5 3.h5 7.h5 threads.h5
}

# A rank that dies ends the job; what is in journals is not computed again, by any number of ranks. The study takes some
# seconds: mpirun hands SIGTERM on after a second only.
dead_rank() {
  whole_study 12000
  "${mpi[@]}" -n 3 "$condyle_mpi" study study.toml -o killed.h5 >killed.log 2>&1 &
  local job=$! victim
  under_way killed.h5
  victim=$(pgrep -P "$job" | tail -n 1)
  kill -9 "$victim" || fail "there was no rank to kill"
  ! wait "$job" || fail "a dead rank did not end the job"
  [ ! -e killed.h5 ] || fail "an incomplete study was written"
  ranks 2 study study.toml -o killed.h5 --resume >resumed.log 2>&1 || fail "resumed: exit code $?"
  same_content whole.h5 killed.h5
  "${mpi[@]}" -n 2 "$condyle_mpi" study study.toml -o again.h5 >again.log 2>&1 &
  job=$!
  under_way again.h5
  kill -TERM "$job"
  ! wait "$job" || fail "SIGTERM did not end the job"
  [ -d again.h5.journal ] || fail "SIGTERM took the journals"
  "$condyle" study study.toml -o again.h5 --resume --threads 2 --quiet
  same_content whole.h5 again.h5
}

# What is wrong with the input is said in one line, once.
one_line() {
  small_study "$knee" 100 'sample = 3' >study.toml
  ! ranks 3 study study.toml -o bad.h5 2>bad.log >bad.out || fail "bad input: exit code 0"
  [ "$(grep -c '^condyle-mpi: ' bad.log)" -eq 1 ] || fail "bad input was not told in one line"
  ! ranks 2 sweep 2>word.log >word.out || fail "bad word: exit code 0"
  [ "$(grep -c '^condyle-mpi: ' word.log)" -eq 1 ] || fail "a bad word was not told in one line"
}

# Two hosts with interfaces of their own, joined by a cable: TCP between the ranks, a launcher in place of ssh.
two_hosts() {
  local a=condyle-a-$$ b=condyle-b-$$
  { ip netns add "$a" && ip netns add "$b"; } 2>/dev/null || { echo "skipped: no network namespaces here" && exit 77; }
  # shellcheck disable=SC2064
  trap "ip netns del $a; ip netns del $b; rm -rf '$work'" EXIT
  ip link add left netns "$a" type veth peer name right netns "$b" 2>/dev/null || { echo "skipped: no veth here" && exit 77; }
  ip -n "$a" address add 10.77.0.1/24 dev left
  ip -n "$b" address add 10.77.0.2/24 dev right
  for host in "$a" "$b"; do ip -n "$host" link set lo up; done
  ip -n "$a" link set left up
  ip -n "$b" link set right up
  printf '#!/bin/sh\nshift\nexec ip netns exec %s unshare --uts sh -c "hostname right; $*"\n' "$b" >launch.sh
  chmod +x launch.sh
  printf '10.77.0.1 slots=2\n10.77.0.2 slots=2\n' >hosts
  whole_study 600
  ip netns exec "$a" unshare --uts sh -c "hostname left
    exec mpirun --hostfile hosts --mca plm rsh --mca plm_rsh_agent $work/launch.sh --mca mpi_yield_when_idle 1 \
      --map-by node --bind-to none -n 3 sh -c 'hostname >>hosts.txt; exec \"\$@\"' sh $condyle_mpi study study.toml -o hosts.h5" \
    >hosts.log 2>&1 || fail "two hosts: exit code $?"
  [ "$(sort hosts.txt | uniq -c | tr -s ' \n' ' ')" = " 2 left 1 right " ] || fail "the ranks were not on two hosts"
  same_content whole.h5 hosts.h5
}

"$2"
