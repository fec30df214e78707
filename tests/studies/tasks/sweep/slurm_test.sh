#!/usr/bin/env bash
# A sweep as a Slurm job array with the script that `flankwright new slurm` prints, on a cluster of this one machine that exists for the
# test only: its samples are those of an unshared run, and a lost shard is found and run again.
#
#   slurm_test.sh FLANKWRIGHT      exit code 77: skipped, with a word why
set -euo pipefail
flankwright=$1

skip() {
  echo "skipped: $*"
  exit 77
}
for program in munged slurmctld slurmd sbatch scancel sinfo; do
  PATH=$PATH:/usr/sbin command -v "$program" >/dev/null || skip "no $program here (Debian: slurm-wlm)"
done
[[ $EUID -eq 0 ]] || skip "slurmd wants to be root"
PATH=$PATH:/usr/sbin

scratch=$(mktemp -d)
daemons=()
clean_up() {
  for ((i = ${#daemons[@]} - 1; i >= 0; --i)); do
    kill "${daemons[i]}" 2>/dev/null && wait "${daemons[i]}" 2>/dev/null || true
  done
  rm -rf "$scratch"
}
trap clean_up EXIT
cd "$scratch"

host=$(hostname -s)
port=$((20000 + $$ % 20000))
mkdir state spool
(umask 077 && head -c 1024 /dev/urandom >munge.key)
cat >slurm.conf <<CONF
ClusterName=one
SlurmctldHost=$host(localhost)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$scratch/munge.socket
CredType=cred/munge
StateSaveLocation=$scratch/state
SlurmdSpoolDir=$scratch/spool
SlurmctldPidFile=$scratch/slurmctld.pid
SlurmdPidFile=$scratch/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
ReturnToService=2
NodeName=$host NodeAddr=localhost CPUs=$(nproc) RealMemory=4000 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF=$scratch/slurm.conf

munged --foreground --force --key-file=munge.key --socket=munge.socket --pid-file="$scratch/munge.pid" \
  --seed-file="$scratch/munge.seed" --log-file="$scratch/munge.log" >/dev/null 2>&1 &
daemons+=($!)
for _ in $(seq 50); do [[ -S munge.socket ]] && break || sleep 0.1; done
slurmctld -D >slurmctld.log 2>&1 &
daemons+=($!)
slurmd -D -N "$host" >slurmd.log 2>&1 &
daemons+=($!)
idle=no
for _ in $(seq 60); do
  if [[ $(sinfo --noheader --format=%t 2>/dev/null || true) == idle* ]]; then
    idle=yes
    break
  fi
  sleep 0.5
done
[[ $idle == yes ]] || skip "slurmctld and slurmd did not come up: $(tail -n 1 slurmctld.log) / $(tail -n 1 slurmd.log)"

"$flankwright" new sweep | sed 's/"fitted"/"thin_slice"/; s/^samples = 1000/samples = 120/' >gear.toml
"$flankwright" new slurm | sed 's/^shards=20/shards=3/; s/--array=1-20/--array=1-3/; s/--cpus-per-task=4/--cpus-per-task=1/' >sweep.sbatch
export FLANKWRIGHT=$flankwright

sbatch --wait --quiet sweep.sbatch gear.toml parts
ls parts/shards
"$flankwright" merge gear.toml --out parts >/dev/null 2>&1
"$flankwright" run gear.toml --out whole >/dev/null 2>&1
cmp parts/samples.csv whole/samples.csv

rm parts/shards/2-of-3.sqlite parts/results.sqlite
if said=$("$flankwright" merge gear.toml --out parts 2>&1); then
  echo "a lost shard was not missed" >&2
  exit 1
fi
grep -q "lost of 3: 2" <<<"$said" || { echo "$said" >&2; exit 1; }
sbatch --wait --quiet --array=2 sweep.sbatch gear.toml parts
"$flankwright" merge gear.toml --out parts >/dev/null 2>&1
cmp parts/samples.csv whole/samples.csv
echo "three shards by Slurm, one lost and run again: the samples of an unshared run"
