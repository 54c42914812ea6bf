# retention-01.sh PROGRAM SOURCE FOLDER NUMDIFF
# Without these refusals, retention curves that are not monotone, rain that falls upwards and
# suction in steps would give wrong results. A start costs 0.4 s: there is one for each kind.
refused() {
  if "$1" "$2/tests/seepage/hydrostatic-01.prm" --output "$3" --quiet --set "$5" >out.txt 2>&1 ||
    ! grep -qF "$4" out.txt; then
    echo "not refused by name: $5"
    exit 1
  fi
}
rm -rf "$3"
mkdir -p "$3"
cd "$3"
check() { refused "$PROGRAM" "$SOURCE" "run" "$1" "$2"; }
PROGRAM=$1 SOURCE=$2
check Materials/sand/Retention\ table 'Materials/sand/Retention table = 0, 1, 1; 1, 0.2, 0.1; 2, 0.3, 0.01'
check Materials/sand/Retention 'Materials/sand/Retention = none'
check Seepage/top/Rain 'Seepage/top/Rain = -1e-6*t'
if "$PROGRAM" "$SOURCE/tests/seepage/hydrostatic-01.prm" --output run --quiet --set 'Analysis/Kind = steps' \
  --set 'Gravity/Acceleration = 0, -9.81' \
  --set 'Materials/soil/Bishop parameter = saturation' >out.txt 2>&1 ||
  ! grep -qF 'Materials/soil/Bishop parameter' out.txt; then
  echo "not refused by name: suction in steps"
  cat out.txt
  exit 1
fi
