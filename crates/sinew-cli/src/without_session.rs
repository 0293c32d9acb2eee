//! `sinew serve` and `sinew join` where sessions are not built in.

/// Whatever is asked for.
#[derive(Debug, clap::Args)]
pub(crate) struct WithoutSession {
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, hide = true)]
    arguments: Vec<String>,
}

impl WithoutSession {
    /// Says how to build them in.
    pub(crate) fn run(self) -> anyhow::Result<()> {
        drop(self.arguments);
        anyhow::bail!(
            "this program was built without sessions: `cargo install --path crates/sinew-cli --features session` in Sinew's \
             repository builds it with them, or put `--features session` behind `cargo run --release`"
        )
    }
}
