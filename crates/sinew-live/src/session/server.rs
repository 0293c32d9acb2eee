//! The server: one socket, one certificate, one stage.

use super::certificate::server_side;
use super::client_connection::{self, ServerState};
use super::limits::{
    DEFAULT_PORT, HELLO_TIMEOUT, MAX_PENDING_CONNECTIONS, MAX_PENDING_PER_ADDRESS, MAX_QUEUED_REQUESTS,
};
use super::role_assignments::RoleAssignments;
use super::stage_queue::{QueuedRequest, ServerCounts, Shared, StageQueue, count};
use super::{Role, SessionError, Token};
use ring::rand::{SecureRandom, SystemRandom};
use sinew_control::Command;
use sinew_stage::Scene;
use std::collections::BTreeMap;
use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::sync::atomic::Ordering;
use std::sync::{Arc, Mutex};
use tokio::sync::watch;

/// Settings of a server, fixed when it is opened.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ServerSettings {
    /// The address that it binds. Default: loopback, port [`DEFAULT_PORT`].
    pub bind: SocketAddr,
    /// Host name of this machine as others know it, for the token. Default: the bound address.
    pub name: Option<String>,
    /// Maximum number of connected clients. Default: 32.
    pub max_clients: usize,
}

impl Default for ServerSettings {
    fn default() -> ServerSettings {
        ServerSettings {
            bind: SocketAddr::new(IpAddr::V4(Ipv4Addr::LOCALHOST), DEFAULT_PORT),
            name: None,
            max_clients: 32,
        }
    }
}

/// What a server sends to clients that join, and checks their requests against.
#[derive(Clone, Debug, Default)]
pub struct SceneManifest {
    /// The scene with all its files: a take without commands.
    pub scene: Arc<[u8]>,
    /// Its characters.
    pub actors: Vec<String>,
    /// Its keys and the commands that they are bound to.
    pub keys: BTreeMap<String, Vec<Command>>,
    /// Physics steps a second.
    pub physics_hz: u32,
    /// Its seed.
    pub seed: u64,
    /// The scene against which commands are checked before they are queued.
    pub rules: Option<Arc<Scene>>,
}

/// A session that others can join. It ends when it is dropped.
pub struct Server {
    address: SocketAddr,
    actor: Token,
    operator: Token,
    shared: Arc<Shared>,
    endpoint: quinn::Endpoint,
    runtime: Option<tokio::runtime::Runtime>,
}

impl Server {
    /// Opens a session. The [`StageQueue`] is for the thread that runs the stage.
    ///
    /// # Errors
    /// An address that cannot be bound, or that no token can name.
    pub fn open(settings: &ServerSettings, manifest: SceneManifest) -> Result<(Server, StageQueue), SessionError> {
        let machine = |error: std::io::Error| SessionError::Local(format!("{}: {error}", settings.bind));
        let (config, fingerprint) = server_side()?;
        let runtime = tokio::runtime::Builder::new_multi_thread()
            .worker_threads(1)
            .thread_name("sinew-session")
            .enable_all()
            .build()
            .map_err(machine)?;
        let endpoint = {
            let _inside = runtime.enter();
            quinn::Endpoint::server(config, settings.bind).map_err(machine)?
        };
        let address = endpoint.local_addr().map_err(machine)?;
        if settings.name.is_none() && address.ip().is_unspecified() {
            let problem = "every address of this machine is bound, so the token cannot name one; state ServerSettings::name, as others \
                           call this machine, or bind one address";
            return Err(SessionError::Local(format!("{address}: {problem}")));
        }
        let host = settings.name.clone().unwrap_or_else(|| address.ip().to_string());
        let secrets = (new_secret()?, new_secret()?);
        let token = |role, secret| Token { role, host: host.clone(), port: address.port(), fingerprint, secret };
        let (actor, operator) = (token(Role::Actor, secrets.0), token(Role::Operator, secrets.1));
        let shared = Arc::new(Shared::default());
        let (request, requests) = std::sync::mpsc::sync_channel::<QueuedRequest>(MAX_QUEUED_REQUESTS);
        let (frames, frames_out) = watch::channel(Arc::default());
        let state = Arc::new(ServerState {
            roles: Mutex::new(RoleAssignments::new(&manifest.actors)),
            manifest,
            secrets: [(Role::Actor, secrets.0), (Role::Operator, secrets.1)],
            request,
            frames: frames_out,
            shared: Arc::clone(&shared),
            max_clients: settings.max_clients,
        });
        runtime.spawn(accept(endpoint.clone(), state));
        let server = Server { address, actor, operator, shared: Arc::clone(&shared), endpoint, runtime: Some(runtime) };
        Ok((server, StageQueue { requests, frames, shared, buffers: Vec::new() }))
    }

    /// The address that it is bound to.
    pub fn address(&self) -> SocketAddr {
        self.address
    }

    /// The token for one role.
    pub fn token(&self, role: Role) -> &Token {
        match role {
            Role::Actor => &self.actor,
            Role::Operator => &self.operator,
        }
    }

    /// Statistics of its connections, requests and frames.
    pub fn counts(&self) -> ServerCounts {
        self.shared.counts.now()
    }

    /// Lets an interrupt from the keyboard (Ctrl-C) ask the stage to stop; a second one ends the program at once.
    pub fn stop_on_interrupt(&self) {
        let shared = Arc::clone(&self.shared);
        if let Some(runtime) = &self.runtime {
            runtime.spawn(async move {
                while tokio::signal::ctrl_c().await.is_ok() {
                    if shared.stop.swap(true, Ordering::Relaxed) {
                        std::process::exit(130);
                    }
                }
            });
        }
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.endpoint.close(client_connection::CLOSED.into(), b"the session is over");
        if let Some(runtime) = self.runtime.take() {
            // All clients are notified; the wait for their acknowledgement is short.
            let told =
                async { tokio::time::timeout(super::limits::KEEP_ALIVE_INTERVAL, self.endpoint.wait_idle()).await };
            let _ = runtime.block_on(told);
            runtime.shutdown_background();
        }
    }
}

/// Accepts connections. The number of those that are not authenticated is limited, in total and for each address.
async fn accept(endpoint: quinn::Endpoint, state: Arc<ServerState>) {
    let pending: Arc<Mutex<BTreeMap<IpAddr, usize>>> = Arc::default();
    let mut client = 0;
    while let Some(incoming) = endpoint.accept().await {
        let from = incoming.remote_address().ip();
        if !incoming.remote_address_validated() && incoming.may_retry() && is_crowded(&pending) {
            // Address validation: a sender with a spoofed address never receives the retry packet, and so takes no
            // slot.
            let _ = incoming.retry();
            continue;
        }
        let slot = {
            let mut known = pending.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
            let all: usize = known.values().sum();
            let here = known.entry(from).or_default();
            if *here >= MAX_PENDING_PER_ADDRESS || all >= MAX_PENDING_CONNECTIONS {
                None
            } else {
                *here += 1;
                Some(PendingConnection { from, pending: Arc::clone(&pending) })
            }
        };
        let Some(slot) = slot else {
            count(&state.shared.counts.connections_refused);
            incoming.refuse();
            continue;
        };
        client += 1;
        let state = Arc::clone(&state);
        tokio::spawn(async move {
            let connection = match tokio::time::timeout(HELLO_TIMEOUT, async { incoming.accept()?.await }).await {
                Ok(Ok(connection)) => connection,
                _ => return count(&state.shared.counts.connections_refused),
            };
            client_connection::receive(state, client, connection, slot).await;
        });
    }
}

/// Whether so many connections are pending that new ones must validate their address.
fn is_crowded(pending: &Mutex<BTreeMap<IpAddr, usize>>) -> bool {
    let known = pending.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    known.values().sum::<usize>() >= MAX_PENDING_PER_ADDRESS / 2
}

/// A connection that is not yet authenticated. It is counted until it is dropped.
pub(super) struct PendingConnection {
    from: IpAddr,
    pending: Arc<Mutex<BTreeMap<IpAddr, usize>>>,
}

impl Drop for PendingConnection {
    fn drop(&mut self) {
        let mut known = self.pending.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        if let Some(here) = known.get_mut(&self.from) {
            *here -= 1;
            if *here == 0 {
                known.remove(&self.from);
            }
        }
    }
}

fn new_secret() -> Result<[u8; 32], SessionError> {
    let mut secret = [0; 32];
    let failed = |_| SessionError::Local("the operating system's random generator failed".to_owned());
    SystemRandom::new().fill(&mut secret).map_err(failed)?;
    Ok(secret)
}
