# Explicit runs with pore water show its excess pressure, and the work of its flow beside the
# other energies.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
"$program" "$root/prm/consolidation/terzaghi_mpm.prm" --quiet --output run \
  --set 'Loading/consolidate/Duration = 0.02' --set 'Loading/consolidate/Step size = 0.01' \
  --set 'Output/Pictures = false' --set 'Output/Expectations ='
PYTHONPATH=$root/python /usr/bin/python3 -B - <<'PYTHON'
from geocone.plots import explicit
from geocone.plots.energy import EXPLICIT, energies_of
from geocone.reader import Run
from geocone.style import finish

run = Run("run")
assert energies_of(run, EXPLICIT)["seepage work"][-1] > 0.
explicit.pictures(run)["excess_pore_pressure.png"](run, run.folder / "excess_pore_pressure.png")
finish()
assert (run.folder / "excess_pore_pressure.png").stat().st_size > 1e4
PYTHON
