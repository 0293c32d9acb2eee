//! The server's self-signed certificate, and the client that trusts only this certificate (certificate pinning).

use super::SessionError;
use super::limits::{IDLE_TIMEOUT, MAX_FRAMES_IN_FLIGHT};
use quinn::crypto::rustls::{QuicClientConfig, QuicServerConfig};
use quinn::{IdleTimeout, TransportConfig, VarInt};
use rustls::client::danger::{HandshakeSignatureValid, ServerCertVerified, ServerCertVerifier};
use rustls::crypto::{CryptoProvider, WebPkiSupportedAlgorithms, verify_tls13_signature};
use rustls::pki_types::{CertificateDer, PrivatePkcs8KeyDer, ServerName, UnixTime};
use rustls::{DigitallySignedStruct, SignatureScheme};
use std::sync::Arc;
use std::time::Duration;

/// ALPN name of the protocol.
const ALPN: &[u8] = b"sinew-session";

/// The name in the certificate; it is not checked.
const NAME: &str = "sinew";

/// Error text for a wrong certificate; [`is_wrong_certificate`] searches for it.
const NOT_PINNED: &str = "not the certificate of the token";

/// Configuration of a server, and the fingerprint of its new certificate.
pub(super) fn server_side() -> Result<(quinn::ServerConfig, [u8; 32]), SessionError> {
    let made = rcgen::generate_simple_self_signed([NAME.to_owned()]).map_err(machine)?;
    let certificate = made.cert.der().clone();
    let print = fingerprint(&certificate);
    let key = PrivatePkcs8KeyDer::from(made.signing_key.serialize_der());
    let mut tls = rustls::ServerConfig::builder_with_provider(provider())
        .with_protocol_versions(&[&rustls::version::TLS13])
        .map_err(machine)?
        .with_no_client_auth()
        .with_single_cert(vec![certificate], key.into())
        .map_err(machine)?;
    tls.alpn_protocols = vec![ALPN.to_vec()];
    // No data before the handshake is complete (no 0-RTT).
    tls.max_early_data_size = 0;
    let quic = QuicServerConfig::try_from(tls).map_err(machine)?;
    let mut config = quinn::ServerConfig::with_crypto(Arc::new(quic));
    let mut transport = transport()?;
    // A client may open its control stream and nothing else; its performance arrives in datagrams.
    transport
        .max_concurrent_bidi_streams(VarInt::from_u32(1))
        .max_concurrent_uni_streams(VarInt::from_u32(0))
        .stream_receive_window(VarInt::from_u32(128 << 10))
        .receive_window(VarInt::from_u32(256 << 10))
        .send_window(2 << 20)
        .datagram_receive_buffer_size(Some(128 << 10));
    config.transport_config(Arc::new(transport));
    config.max_incoming(128).incoming_buffer_size(32 << 10).incoming_buffer_size_total(2 << 20);
    Ok((config, print))
}

/// Configuration of a client that accepts one certificate only.
pub(super) fn client_side(fingerprint: [u8; 32]) -> Result<quinn::ClientConfig, SessionError> {
    let provider = provider();
    let pinned = Pinned { fingerprint, algorithms: provider.signature_verification_algorithms };
    let mut tls = rustls::ClientConfig::builder_with_provider(provider)
        .with_protocol_versions(&[&rustls::version::TLS13])
        .map_err(machine)?
        .dangerous()
        .with_custom_certificate_verifier(Arc::new(pinned))
        .with_no_client_auth();
    tls.alpn_protocols = vec![ALPN.to_vec()];
    tls.enable_early_data = false;
    let quic = QuicClientConfig::try_from(tls).map_err(machine)?;
    let mut config = quinn::ClientConfig::new(Arc::new(quic));
    let mut transport = transport()?;
    transport
        .max_concurrent_bidi_streams(VarInt::from_u32(0))
        .max_concurrent_uni_streams(VarInt::from_u32(MAX_FRAMES_IN_FLIGHT))
        .receive_window(VarInt::from_u32(8 << 20))
        .datagram_send_buffer_size(64 << 10)
        // QUIC allows a side to send datagrams only if it also has a receive buffer for them.
        .datagram_receive_buffer_size(Some(16 << 10));
    config.transport_config(Arc::new(transport));
    Ok(config)
}

/// Whether a connection failed because of the certificate.
pub(super) fn is_wrong_certificate(error: &quinn::ConnectionError) -> bool {
    matches!(error, quinn::ConnectionError::TransportError(error) if error.reason.contains(NOT_PINNED))
}

/// The name that a client connects to.
pub(super) fn server_name() -> &'static str {
    NAME
}

/// Initial congestion window \[bytes\]: a few frames.
const FIRST_WINDOW: u64 = 48 << 10;

fn transport() -> Result<TransportConfig, SessionError> {
    let mut window = quinn::congestion::CubicConfig::default();
    window.initial_window(FIRST_WINDOW);
    let mut transport = TransportConfig::default();
    transport
        .congestion_controller_factory(Arc::new(window))
        .max_idle_timeout(Some(IdleTimeout::try_from(IDLE_TIMEOUT).map_err(machine)?))
        .keep_alive_interval(Some(Duration::from_secs(1)))
        .initial_rtt(Duration::from_millis(100));
    Ok(transport)
}

fn provider() -> Arc<CryptoProvider> {
    Arc::new(rustls::crypto::ring::default_provider())
}

fn machine(error: impl std::fmt::Display) -> SessionError {
    SessionError::Local(format!("the encryption cannot be set up: {error}"))
}

fn fingerprint(certificate: &CertificateDer) -> [u8; 32] {
    let digest = ring::digest::digest(&ring::digest::SHA256, certificate);
    let mut print = [0; 32];
    print.copy_from_slice(digest.as_ref());
    print
}

/// Accepts one certificate. Names, dates and authorities are ignored: the token carries the fingerprint.
#[derive(Debug)]
struct Pinned {
    fingerprint: [u8; 32],
    algorithms: WebPkiSupportedAlgorithms,
}

impl ServerCertVerifier for Pinned {
    fn verify_server_cert(
        &self,
        end_entity: &CertificateDer<'_>,
        _intermediates: &[CertificateDer<'_>],
        _server_name: &ServerName<'_>,
        _ocsp_response: &[u8],
        _now: UnixTime,
    ) -> Result<ServerCertVerified, rustls::Error> {
        if fingerprint(end_entity) == self.fingerprint {
            Ok(ServerCertVerified::assertion())
        } else {
            Err(rustls::Error::General(NOT_PINNED.to_owned()))
        }
    }

    fn verify_tls12_signature(
        &self,
        _message: &[u8],
        _cert: &CertificateDer<'_>,
        _dss: &DigitallySignedStruct,
    ) -> Result<HandshakeSignatureValid, rustls::Error> {
        Err(rustls::Error::General("QUIC is TLS 1.3".to_owned()))
    }

    fn verify_tls13_signature(
        &self,
        message: &[u8],
        cert: &CertificateDer<'_>,
        dss: &DigitallySignedStruct,
    ) -> Result<HandshakeSignatureValid, rustls::Error> {
        verify_tls13_signature(message, cert, dss, &self.algorithms)
    }

    fn supported_verify_schemes(&self) -> Vec<SignatureScheme> {
        self.algorithms.supported_schemes()
    }
}
