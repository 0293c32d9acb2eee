//! Peers that mean harm, or are just broken: they harm themselves, and nobody else notices.
#![allow(clippy::unwrap_used, reason = "a helper of a test fails as the test does")]

use crate::session_setup::{ServerState, agree, join, until, watch_until};
use quinn::crypto::rustls::QuicClientConfig;
use rustls::client::danger::{HandshakeSignatureValid, ServerCertVerified, ServerCertVerifier};
use rustls::pki_types::{CertificateDer, ServerName, UnixTime};
use rustls::{DigitallySignedStruct, SignatureScheme};
use sinew_live::session::{Client, ConnectionState, PROTOCOL, Role, Token};
use std::net::UdpSocket;
use std::sync::Arc;

/// An honest client that goes on all the while.
fn goes_on(red: &Client) {
    let now = red.stats().last_step.unwrap();
    watch_until(red, now + 60);
    assert_eq!(red.state(), ConnectionState::Connected);
    let stats = red.stats();
    assert_eq!((stats.frames_that_differ, stats.frames_malformed, stats.rejoined), (0, 0, 0));
}

/// A connection of somebody who follows no rule of ours.
struct Rude {
    endpoint: quinn::Endpoint,
    runtime: tokio::runtime::Runtime,
}

impl Rude {
    fn new() -> Rude {
        let runtime = tokio::runtime::Builder::new_multi_thread().worker_threads(1).enable_all().build().unwrap();
        let _inside = runtime.enter();
        let provider = Arc::new(rustls::crypto::ring::default_provider());
        let mut tls = rustls::ClientConfig::builder_with_provider(provider)
            .with_protocol_versions(&[&rustls::version::TLS13])
            .unwrap()
            .dangerous()
            .with_custom_certificate_verifier(Arc::new(Trusting))
            .with_no_client_auth();
        tls.alpn_protocols = vec![b"sinew-session".to_vec()];
        let config = quinn::ClientConfig::new(Arc::new(QuicClientConfig::try_from(tls).unwrap()));
        let mut endpoint = quinn::Endpoint::client("127.0.0.1:0".parse().unwrap()).unwrap();
        endpoint.set_default_client_config(config);
        drop(_inside);
        Rude { endpoint, runtime }
    }

    fn connect(&self, token: &Token) -> quinn::Connection {
        let to = token.address().parse().unwrap();
        self.runtime.block_on(async { self.endpoint.connect(to, "x").unwrap().await.unwrap() })
    }

    /// Says these bytes on the control stream, after a greeting if one is asked for, and waits for the server's end.
    fn say(&self, token: &Token, greets: bool, bytes: &[u8]) -> quinn::ConnectionError {
        let connection = self.connect(token);
        let greeting = greeting(token, &[]);
        self.runtime.block_on(async {
            let (mut to, _from) = connection.open_bi().await.unwrap();
            if greets {
                to.write_all(&greeting).await.unwrap();
            }
            // The server may have closed before all is said.
            let _ = to.write_all(bytes).await;
            connection.closed().await
        })
    }
}

fn message(text: &str) -> Vec<u8> {
    let mut bytes = (text.len() as u32).to_le_bytes().to_vec();
    bytes.extend(text.as_bytes());
    bytes
}

fn greeting(token: &Token, actors: &[&str]) -> Vec<u8> {
    let text = token.to_string();
    let secret = text.rsplit('/').next().unwrap();
    message(&serde_json::json!({"protocol": PROTOCOL, "secret": secret, "actors": actors}).to_string())
}

#[test]
fn garbage_and_floods_before_the_greeting_harm_nobody() {
    let state = ServerState::open();
    let token = state.token(Role::Actor);
    let red = join(&token, &["red"]).unwrap();
    watch_until(&red, 8);
    let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
    for packet in 0..3000u32 {
        // Long ones that look like the beginning of a connection, short ones, and noise.
        let first = [0xc0, 0x40, 0xff, 0x00][packet as usize % 4];
        let bytes: Vec<u8> = (0..1 + packet as usize * 7 % 1300)
            .map(|at| if at == 0 { first } else { (packet.wrapping_mul(2_654_435_761) >> (at % 24)) as u8 })
            .collect();
        socket.send_to(&bytes, state.server.address()).unwrap();
    }
    let rude = Rude::new();
    rude.say(&token, false, &u32::MAX.to_le_bytes());
    rude.say(&token, false, &message("not a greeting"));
    rude.say(&token, false, &message(&"[".repeat(4000)));
    goes_on(&red);
    // More who connect and say nothing than strangers are let in from one address.
    let silent: Vec<_> = (0..12).map(|_| rude.connect(&token)).collect();
    goes_on(&red);
    assert!(join(&token, &["blue"]).is_ok(), "there is room for one who greets");
    until("the end of the silent", || silent.iter().all(|connection| connection.close_reason().is_some()));
    goes_on(&red);
    assert!(state.counts().connections_refused >= 15, "{:?}", state.counts());
    agree(&red.stats().hashes, &state.close().hashes);
}

#[test]
fn who_breaks_the_rules_after_joining_is_cut_off_alone() {
    let state = ServerState::open();
    let token = state.token(Role::Actor);
    let red = join(&token, &["red"]).unwrap();
    watch_until(&red, 8);
    let rude = Rude::new();
    let is_cut_off = |error: quinn::ConnectionError| matches!(error, quinn::ConnectionError::ApplicationClosed(_));
    assert!(is_cut_off(rude.say(&token, true, &u32::MAX.to_le_bytes())), "a length of four gigabytes");
    assert!(is_cut_off(rude.say(&token, true, &message("{\"command\": {}}"))), "no command");
    assert!(is_cut_off(rude.say(&token, true, &[7, 0, 0, 0, 0xff, 0xfe, 0, 1, 2, 3, 4])), "no text");
    let connection = rude.connect(&token);
    let greeting = greeting(&token, &["blue"]);
    let closed = rude.runtime.block_on(async {
        let (mut to, _from) = connection.open_bi().await.unwrap();
        to.write_all(&greeting).await.unwrap();
        for length in 0..100 {
            let _ = connection.send_datagram(vec![0xaa; length].into());
        }
        connection.closed().await
    });
    assert!(is_cut_off(closed), "datagrams of noise");
    goes_on(&red);
    assert!(join(&token, &["blue"]).is_ok(), "its actor is free again");
    assert_eq!(state.counts().requests, 0);
    agree(&red.stats().hashes, &state.close().hashes);
}

#[test]
fn who_takes_nothing_or_sends_too_much_slows_only_itself() {
    let state = ServerState::open();
    let token = state.token(Role::Actor);
    let red = join(&token, &["red"]).unwrap();
    watch_until(&red, 8);
    let rude = Rude::new();
    let (slow, flood) = (rude.connect(&token), rude.connect(&token));
    let (to_slow, to_flood) = (greeting(&token, &[]), greeting(&token, &["blue"]));
    // One greets and reads no stream; its streams stay open at its side until no more may be opened.
    let (_slow_to, _slow_from) = rude.runtime.block_on(async {
        let (mut to, from) = slow.open_bi().await.unwrap();
        to.write_all(&to_slow).await.unwrap();
        (to, from)
    });
    // The other sends presses as fast as it can, and noise beside that means it lives.
    let press = message("{\"press\":\"p\"}");
    let flooding = rude.runtime.spawn(async move {
        let (mut to, _from) = flood.open_bi().await.unwrap();
        to.write_all(&to_flood).await.unwrap();
        for _ in 0..50_000 {
            let _ = flood.send_datagram(vec![0; 9].into());
            if to.write_all(&press).await.is_err() {
                break;
            }
        }
    });
    goes_on(&red);
    let before = red.stats().sent.len();
    red.press("p");
    until("red's press", || state.counts().requests >= 1);
    assert_eq!(red.stats().sent.len(), before + 1);
    until("frames that nobody takes", || state.counts().frames_dropped > 0);
    goes_on(&red);
    flooding.abort();
    let steps = red.stats().last_step.unwrap();
    let done = state.close();
    assert!(done.applied.iter().any(|applied| applied.by == "red"));
    // Its presses are not bound to its own actor, so none is applied; and none is looked at faster than sixty a second.
    assert!(done.applied.iter().all(|applied| applied.by != "blue"), "after {steps} steps");
    agree(&red.stats().hashes, &done.hashes);
}

/// Believes anybody.
#[derive(Debug)]
struct Trusting;

impl ServerCertVerifier for Trusting {
    fn verify_server_cert(
        &self,
        _: &CertificateDer<'_>,
        _: &[CertificateDer<'_>],
        _: &ServerName<'_>,
        _: &[u8],
        _: UnixTime,
    ) -> Result<ServerCertVerified, rustls::Error> {
        Ok(ServerCertVerified::assertion())
    }

    fn verify_tls12_signature(
        &self,
        _: &[u8],
        _: &CertificateDer<'_>,
        _: &DigitallySignedStruct,
    ) -> Result<HandshakeSignatureValid, rustls::Error> {
        Ok(HandshakeSignatureValid::assertion())
    }

    fn verify_tls13_signature(
        &self,
        _: &[u8],
        _: &CertificateDer<'_>,
        _: &DigitallySignedStruct,
    ) -> Result<HandshakeSignatureValid, rustls::Error> {
        Ok(HandshakeSignatureValid::assertion())
    }

    fn supported_verify_schemes(&self) -> Vec<SignatureScheme> {
        rustls::crypto::ring::default_provider().signature_verification_algorithms.supported_schemes()
    }
}
