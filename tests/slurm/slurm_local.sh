#!/usr/bin/env bash
# A private Slurm on one machine, as root, without systemd, cgroups and slurmdbd. For tests.
#   slurm_local.sh start DIR NODES PORT   ports PORT and PORT+1 … PORT+NODES; prints the configuration's path
#   slurm_local.sh stop DIR
set -euo pipefail
command=$1
dir=$(realpath -m "$2")

if [ "$command" = stop ]; then
  for file in "$dir"/run/*.pid; do
    [ -s "$file" ] && kill "$(cat "$file")" 2>/dev/null || true
  done
  exit 0
fi

nodes=$3
port=$4
host=$(hostname -s)
user=$(id -un)
mkdir -p "$dir"/run "$dir"/log "$dir"/state
chmod 755 "$dir" "$dir"/run "$dir"/log
for node in $(seq "$nodes"); do mkdir -p "$dir/spool.n$node"; done
head -c 1024 /dev/urandom >"$dir/run/munge.key"
chmod 600 "$dir/run/munge.key"
cat >"$dir/slurm.conf" <<C
ClusterName=markervp
SlurmctldHost=$host(127.0.0.1)
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
AuthInfo=socket=$dir/run/munge.socket
CredType=cred/munge
SlurmctldPort=$port
StateSaveLocation=$dir/state
SlurmdSpoolDir=$dir/spool.%n
SlurmctldPidFile=$dir/run/slurmctld.pid
SlurmdPidFile=$dir/run/slurmd.%n.pid
SlurmctldLogFile=$dir/log/slurmctld.log
SlurmdLogFile=$dir/log/slurmd.%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
ReturnToService=2
SlurmdParameters=config_overrides
SchedulerParameters=sched_min_interval=50000,sched_interval=1,batch_sched_delay=0
NodeName=n[1-$nodes] NodeHostname=$host NodeAddr=127.0.0.1 Port=[$((port + 1))-$((port + nodes))] CPUs=1 RealMemory=1000 State=UNKNOWN
PartitionName=test Nodes=n[1-$nodes] Default=YES MaxTime=INFINITE State=UP
C
# Nothing uses cgroups, but slurmd looks for them; this plugin starts without any mounted, as in a container.
echo 'CgroupPlugin=cgroup/v1' >"$dir/cgroup.conf"
munged --key-file="$dir/run/munge.key" --socket="$dir/run/munge.socket" --pid-file="$dir/run/munged.pid" \
  --log-file="$dir/log/munged.log" --seed-file="$dir/run/munged.seed" >&2
export SLURM_CONF=$dir/slurm.conf
for _ in $(seq 100); do [ -S "$dir/run/munge.socket" ] && break; sleep .1; done
slurmctld -f "$SLURM_CONF" >&2
for _ in $(seq 100); do scontrol ping 2>/dev/null | grep -q UP && break; sleep .2; done
for node in $(seq "$nodes"); do slurmd -N "n$node" -f "$SLURM_CONF" >&2; done
for _ in $(seq 100); do
  [ "$(sinfo -h -N -t idle 2>/dev/null | wc -l)" = "$nodes" ] && { echo "$SLURM_CONF"; exit 0; }
  sleep .3
done
echo "slurm_local.sh: the nodes do not come up; see $dir/log" >&2
exit 1
