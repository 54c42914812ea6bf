# OpenBLAS selects its kernels by the model of the processor, and takes those of SSE3 for
# models that it does not know: with AVX2 they must not be used, unless they are asked for.
program=$1 root=$2 folder=$3
unset OPENBLAS_CORETYPE
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
core() {
  "$program" "$root/tests/footing_coarse.prm" --quiet --output "$1" \
    --set 'Output/Report for tests = none' --set 'Loading/push/Duration = 0.02'
  grep -o '"blas_core": "[^"]*"' "$1/summary.json" | cut -d'"' -f4
}
found=$(core found)
echo "$found"
[ -n "$found" ]
if grep -qw avx2 /proc/cpuinfo; then
  case $found in Barcelona | Core2 | Nehalem | Prescott | Sandybridge) exit 1 ;; esac
fi
if [ "$found" != unknown ] && [ "$(uname -m)" = x86_64 ]; then
  [ "$(OPENBLAS_CORETYPE=Prescott core asked_for)" = Prescott ]
fi
