# A study that is interrupted goes on where it was; a run whose parameters change,
# also in a file that it includes, is computed again.
program=$1 source=$2 folder=$3
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
cp "$source/prm/footing.prm" scene.prm
echo 'include scene.prm' >footing.prm
cat >three.toml <<'END'
title = "Three"
[defaults]
file = "footing.prm"
set = ["Mesh/Type = uniform", "Mesh/Cell size = 0.2", "Output/Fields = false", "Output/Pictures = false", "Loading/push/Duration = 0.04"]
[[group]]
name = "quick ones"
[group.vary]
phi = {values = [20, 30], set = ["Materials/soil/Friction angle = {}", "Materials/soil/Dilatancy angle = {phi/2}"]}
[[group]]
name = "endless"
set = ["Loading/push/Duration = 1e6"]
END
study="$source/scripts/study three.toml --cores 1 --program $program --output results"
$study 2>log &
pid=$!
# The endless one is the last: the other two have been recorded by then.
for _ in $(seq 600); do
  [ -d results/runs/three/endless ] && break
  sleep 0.1
done
kill -TERM $pid
wait $pid || code=$?
[ "${code:-0}" = 143 ]
[ ! -e results/runs/three/endless.json ]

sed -i 's/1e6/0.02/' three.toml
$study 2>log_again
grep -q '2/3 done.* 2 there from before' log_again
grep -q '3/3 done: endless' log_again
grep -q 'Dilatancy angle = 10' results/three.csv
[ "$(wc -l <results/three.csv)" = 4 ]

echo '# changed' >>scene.prm
$study 2>log_changed
grep -q '0/3 done' log_changed

# A run that takes too long is a line with its reason.
sed -i 's/Duration = 0.02/Duration = 1e6/; s/^title.*/&/; s/^\[defaults\]/&\ntime_limit = 2/' three.toml
$study 2>log_limit
grep -q 'endless: no end in 2 s' log_limit
grep -q "^endless,,failed,no end in 2 s" results/three.csv
