//! The server: one socket, one certificate, one stage.

use super::certificate::server_side;
use super::client_connection::{self, ServerState};
use super::limits::{DEFAULT_PORT, HELLO_WITHIN, MAX_ORDERS, MAX_STRANGERS, MAX_STRANGERS_OF_ONE};
use super::role_assignments::RoleAssignments;
use super::stage_queue::{Placed, ServerCounts, Shared, StageQueue, count};
use super::{Role, SessionError, Token};
use ring::rand::{SecureRandom, SystemRandom};
use sinew_control::Command;
use sinew_stage::Scene;
use std::collections::BTreeMap;
use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::sync::atomic::Ordering;
use std::sync::{Arc, Mutex};
use tokio::sync::watch;

/// Where and for whom a server opens.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ServerSettings {
    /// The address that it binds. Loopback unless more is asked for.
    pub bind: SocketAddr,
    /// What others call this machine, for the token; the bound address when left out.
    pub name: Option<String>,
    /// Clients that may be in at a time.
    pub most_clients: usize,
}

impl Default for ServerSettings {
    fn default() -> ServerSettings {
        ServerSettings {
            bind: SocketAddr::new(IpAddr::V4(Ipv4Addr::LOCALHOST), DEFAULT_PORT),
            name: None,
            most_clients: 32,
        }
    }
}

/// What a server tells those who join, and needs to know to let them.
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
    /// The scene, to which commands are held before they are passed on.
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
        let machine = |error: std::io::Error| SessionError::Machine(format!("{}: {error}", settings.bind));
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
            let problem = "every address of this machine is bound, so the token cannot name one; add --name HOST, as others \
                           call this machine, or bind one address";
            return Err(SessionError::Machine(format!("{address}: {problem}")));
        }
        let host = settings.name.clone().unwrap_or_else(|| address.ip().to_string());
        let secrets = (new_secret()?, new_secret()?);
        let token = |role, secret| Token { role, host: host.clone(), port: address.port(), fingerprint, secret };
        let (actor, operator) = (token(Role::Actor, secrets.0), token(Role::Operator, secrets.1));
        let shared = Arc::new(Shared::default());
        let (order, orders) = std::sync::mpsc::sync_channel::<Placed>(MAX_ORDERS);
        let (frames, frames_out) = watch::channel(Arc::default());
        let state = Arc::new(ServerState {
            roles: Mutex::new(RoleAssignments::new(&manifest.actors)),
            manifest,
            secrets: [(Role::Actor, secrets.0), (Role::Operator, secrets.1)],
            order,
            frames: frames_out,
            shared: Arc::clone(&shared),
            most_clients: settings.most_clients,
        });
        runtime.spawn(accept(endpoint.clone(), state));
        let server = Server { address, actor, operator, shared: Arc::clone(&shared), endpoint, runtime: Some(runtime) };
        Ok((server, StageQueue { orders, frames, shared, buffers: Vec::new() }))
    }

    /// The address that it is bound to.
    pub fn address(&self) -> SocketAddr {
        self.address
    }

    /// The way in for one role.
    pub fn token(&self, role: Role) -> &Token {
        match role {
            Role::Actor => &self.actor,
            Role::Operator => &self.operator,
        }
    }

    /// What came of all that arrived.
    pub fn counts(&self) -> ServerCounts {
        self.shared.counts.now()
    }

    /// Lets an interrupt from the keyboard ask the stage to stop; a second one ends the program as ever.
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
            // Everybody is told, and nobody is waited for long.
            let told = async { tokio::time::timeout(super::limits::SIGN_OF_LIFE, self.endpoint.wait_idle()).await };
            let _ = runtime.block_on(told);
            runtime.shutdown_background();
        }
    }
}

/// Lets connections in: strangers are few at a time, over all and from one address.
async fn accept(endpoint: quinn::Endpoint, state: Arc<ServerState>) {
    let strangers: Arc<Mutex<BTreeMap<IpAddr, usize>>> = Arc::default();
    let mut client = 0;
    while let Some(incoming) = endpoint.accept().await {
        let from = incoming.remote_address().ip();
        if !incoming.remote_address_validated() && incoming.may_retry() && are_many(&strangers) {
            // Whoever writes under false addresses never gets the answer, and so takes no place.
            let _ = incoming.retry();
            continue;
        }
        let pass = {
            let mut known = strangers.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
            let all: usize = known.values().sum();
            let here = known.entry(from).or_default();
            if *here >= MAX_STRANGERS_OF_ONE || all >= MAX_STRANGERS {
                None
            } else {
                *here += 1;
                Some(PendingConnection { from, strangers: Arc::clone(&strangers) })
            }
        };
        let Some(pass) = pass else {
            count(&state.shared.counts.strangers_refused);
            incoming.refuse();
            continue;
        };
        client += 1;
        let state = Arc::clone(&state);
        tokio::spawn(async move {
            let connection = match tokio::time::timeout(HELLO_WITHIN, async { incoming.accept()?.await }).await {
                Ok(Ok(connection)) => connection,
                _ => return count(&state.shared.counts.strangers_refused),
            };
            client_connection::receive(state, client, connection, pass).await;
        });
    }
}

/// Whether so many strangers are here that each has to show that it is where it says.
fn are_many(strangers: &Mutex<BTreeMap<IpAddr, usize>>) -> bool {
    let known = strangers.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    known.values().sum::<usize>() >= MAX_STRANGERS_OF_ONE / 2
}

/// A connection that has not shown the secret yet. It is counted until it is dropped.
pub(super) struct PendingConnection {
    from: IpAddr,
    strangers: Arc<Mutex<BTreeMap<IpAddr, usize>>>,
}

impl Drop for PendingConnection {
    fn drop(&mut self) {
        let mut known = self.strangers.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
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
    let failed = |_| SessionError::Machine("this machine gives no random numbers".to_owned());
    SystemRandom::new().fill(&mut secret).map_err(failed)?;
    Ok(secret)
}
