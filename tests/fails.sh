# What must fail in a test: "! ..." alone would not end a script that ends where
# something fails.
fails() {
  ! "$@"
}
