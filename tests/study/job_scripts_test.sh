#!/usr/bin/env bash
# The scripts of data/jobs: read by bash, and the array run as Slurm would. job_scripts_test.sh CONDYLE. Ends with 77 where
# h5py is missing.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../tools/study/small_study.sh"
condyle=$(realpath "$1")
data=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../../data")
for script in "$data"/jobs/*.slurm; do bash -n "$script"; done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
small_study "$data/wismans-type/knee.toml" 600 >study.toml
PATH=$(dirname "$condyle"):$PATH
export PATH SLURM_CPUS_PER_TASK=2 SLURM_ARRAY_TASK_COUNT=3
for task in 2 3 1; do SLURM_ARRAY_TASK_ID=$task bash "$data/jobs/parts.slurm" study.toml parts.h5; done
condyle study study.toml -o parts.h5 --merge --quiet
condyle study study.toml -o whole.h5 --threads 1 --quiet
same_content whole.h5 parts.h5
# The other one with a launcher in place of srun.
mkdir bin
printf '#!/bin/sh\nshift 2\nexec condyle "$@"\n' >bin/srun
chmod +x bin/srun
PATH=$PWD/bin:$PATH
bash "$data/jobs/ranks.slurm" study.toml ranks.h5
same_content whole.h5 ranks.h5
