# The network and the programs of docs/several-machines.md as functions: two machines and a cable.
export PATH="$PATH:/usr/sbin:/sbin"
lcm_url="udpm://239.255.76.67:7667?ttl=1"

in_machine() { ip netns exec "$1" "${@:2}"; }

make_network() {
  ip netns add arm
  ip netns add leg
  ip link add eth0 netns arm type veth peer name eth0 netns leg
  local machine number=1
  for machine in arm leg; do
    in_machine $machine ip link set lo up
    in_machine $machine ip link set eth0 up multicast on
    in_machine $machine ip address add 10.7.0.$number/24 dev eth0
    in_machine $machine ip route add 239.255.76.67/32 dev eth0
    number=$((number + 1))
  done
}

# Makes a key for each machine, and one for the operator, which both machines authorize.
make_keys() {
  local key
  for key in operator arm leg; do
    rm -f $key.key $key.key.pub
    ./strainwavectl keygen --out $key.key --role engineer --comment $key >/dev/null
  done
  cat operator.key.pub arm.key.pub >arm.keys
  cat operator.key.pub leg.key.pub >leg.keys
}

# start_daemon MACHINE JOINT: starts a daemon with the machine's name as its prefix.
start_daemon() {
  sed -e "s/^prefix = .*/prefix = \"$1\"\nlcm_url = \"udpm:\/\/239.255.76.67:7667?ttl=1\"/" \
    -e "s/^unsigned_orders = .*/unsigned_orders = \"refuse\"\nauthorized_keys = \"$1.keys\"/" \
    -e "s/^name = .*/name = \"$2\"/" demo.toml >$1.toml
  in_machine $1 ./strainwaved --config $1.toml 2>$1.log &
  echo $! >>daemons.pid
}
stop_daemons() {
  xargs -r kill <daemons.pid 2>/dev/null || true
  wait || true
}

# as KEY ARGUMENT...: runs strainwavectl with that key, as the operator does at the arm's PC.
as() { in_machine arm ./strainwavectl --lcm-url "$lcm_url" --key "$1.key" --timeout_s 20 "${@:2}"; }
ctl() { as operator "$@"; }
unsigned() { in_machine arm ./strainwavectl --lcm-url "$lcm_url" --timeout_s 20 "$@"; }
