//! The program. Everything is in the library beside it, so that the level of optimisation of this last piece, which is
//! that of the passes over the whole program, is not that of the shell (`published` in the workspace's `Cargo.toml`).

fn main() -> std::process::ExitCode {
    freestand_cli::run()
}
