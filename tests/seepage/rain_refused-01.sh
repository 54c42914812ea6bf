# rain_refused-01.sh PROGRAM SOURCE FOLDER NUMDIFF
# Rain that is negative at a later time would draw water out of the soil.
rm -rf "$3"
mkdir -p "$3"
cd "$3"
if "$1" "$2/tests/seepage/hydrostatic-01.prm" --output run --quiet \
  --set 'Seepage/top/Rain = -1e-6*t' >out.txt 2>&1 ||
  ! grep -qF "parameter 'Seepage/top/Rain'" out.txt; then
  echo "not refused by name:"
  cat out.txt
  exit 1
fi
